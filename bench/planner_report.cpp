#include "planner_report.h"

#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <thread>

#include "core/error.h"
#include "planner_timing.h"

namespace dstylize {
namespace {

constexpr int kNameWidth = 50;

std::string machine() {
    std::ifstream cpu("/proc/cpuinfo");
    for (std::string line; std::getline(cpu, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown";
}

nlohmann::ordered_json ns_of(const Times& t) {
    nlohmann::ordered_json ns;
    const auto put = [&](const char* name, double time) {
        if (time > 0) ns[name] = time;
    };
    put("tiles", t.tiles), put("tiles_by_two", t.tiles_by_two), put("bucket", t.bucket);
    put("heap", t.heap), put("boost", t.boost), put("scissors", t.scissors);
    return ns;
}

std::string columns(const Times& t) {
    std::string out;
    for (const double time : {t.tiles, t.tiles_by_two, t.bucket, t.heap, t.boost, t.scissors})
        out += fmt::format("{:>{}}", time > 0 ? fmt::format("{:.1f}", time) : "-", out.size() < 35 ? 7 : 9);
    return out;
}

std::string ratio_text(double ratio, double bar) {
    if (ratio == 0) return "-";
    return bar > 0 ? fmt::format("{:.3g} / {:g}", ratio, bar) : fmt::format("{:.3g}", ratio);
}

}  // namespace

Report::Report(double mega) {
    const unsigned threads = std::thread::hardware_concurrency();
    can_judge_two_ = threads >= 2;
    json_ = {{"machine", machine()}, {"threads", threads}, {"megapixels", mega}, {"rows", nlohmann::json::array()}};
    fmt::print("{} megapixels on {}, {} threads; nanoseconds per node, then ratios / bars\n", mega, machine(), threads);
    fmt::print("{:<{}}{:>7}{:>7}{:>7}{:>7}{:>7}{:>9}  {:>12}{:>12}{:>12}{:>12}{:>12}\n", "map, metric, edges",
               kNameWidth, "tiles", "by two", "bucket", "heap", "Boost", "scissors", "heap", "by two", "Boost",
               "by two", "threads");
}

void Report::add(const Row& row, const Measured& measured) {
    if (row.metric == Metric::sum && row.edges != Edges::irregular)
        total_ += measured.times.tiles, total_by_two_ += measured.times.tiles_by_two;
    ratios_.insert(ratios_.end(), measured.ratios.begin(), measured.ratios.end());
    add(name_of(row), {{"map", row.map}, {"metric", metric_names()[std::size_t(row.metric)]}}, measured.times,
        row.bars);
}

void Report::add_stippling(const Times& times, std::size_t points, const Bars& bars) {
    add(fmt::format("portrait, stippling, {} points", points), {{"map", "portrait"}, {"metric", "stippling"}}, times,
        bars);
}

void Report::add(const std::string& name, nlohmann::ordered_json record, const Times& t, const Bars& bars) {
    struct Ratio {
        const char* name;
        double of, to, bar;
        bool by_two;
    };
    const Ratio ratios[] = {{"heap", t.heap, t.tiles, bars.heap, false},
                            {"heap_by_two", t.heap, t.tiles_by_two, bars.heap_by_two, true},
                            {"boost", t.boost, t.tiles, bars.boost, false},
                            {"boost_by_two", t.boost, t.tiles_by_two, bars.boost_by_two, true},
                            {"two_threads", t.tiles, t.tiles_by_two, 0, true}};
    record["name"] = name;
    record["ns"] = ns_of(t);
    bool ok = true;
    std::string text;
    for (const Ratio& r : ratios) {
        const double ratio = r.of > 0 && r.to > 0 ? r.of / r.to : 0;
        text += fmt::format("{:>12}", ratio_text(ratio, r.bar));
        if (ratio == 0) continue;
        record["ratios"][r.name] = ratio;
        if (r.bar > 0) record["bars"][r.name] = r.bar;
        ok = ok && (reaches(ratio, r.bar) || (r.by_two && !can_judge_two_));
    }
    record["ok"] = ok;
    ok_ = ok_ && ok;
    json_["rows"].push_back(record);
    fmt::print("{:<{}}{}  {}{}\n", name, kNameWidth, columns(t), text, ok ? "" : "  TOO SLOW");
    std::fflush(stdout);
}

void Report::finish(double bar_of_two_threads) {
    if (bar_of_two_threads > 0 && total_by_two_ > 0)
        ratios_.push_back({"sum on square lattices, total: one thread / two", total_ / total_by_two_,
                           bar_of_two_threads, false, true});
    if (ratios_.empty()) return;
    constexpr int kWidth = 80;
    fmt::print("\n{:<{}}{:>12}  bar\n", "our own times beside each other", kWidth, "ratio");
    for (const OwnRatio& r : ratios_) {
        const bool no_bar = r.bar == 0 || (r.by_two && !can_judge_two_);
        const bool ok = no_bar || (r.at_most ? stays_below(r.value, r.bar) : reaches(r.value, r.bar));
        const char* const kind = r.at_most ? "at most" : "at least";
        fmt::print("{:<{}}{:>12.3g}  {}{}\n", r.name, kWidth, r.value,
                   r.bar > 0 ? fmt::format("{} {:g}", kind, r.bar) : "-", ok ? "" : "  MISSED");
        nlohmann::ordered_json record = {{"name", r.name}, {"ratio", r.value}, {"ok", ok}};
        if (r.bar > 0) record[r.at_most ? "at_most" : "at_least"] = r.bar;
        json_["own_ratios"].push_back(record);
        ok_ = ok_ && ok;
    }
}

void Report::write(const std::string& path) const {
    std::ofstream file(path);
    file << json_.dump(2) << '\n';
    if (!file.flush()) throw Error(ErrorCode::cannot_write, path, "cannot be written", "");
}

}  // namespace dstylize
