// The tile planner with one and two threads beside its peers, on maps of several kinds: nanoseconds per node,
// all included. Labels must be equal, or it exits with 2; below 0.85 of a bar it exits with 1.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "core/error.h"
#include "graph/bucket_planner.h"
#include "graph/height_planes.h"
#include "graph/scattered_lattice.h"
#include "graph/tile_planner.h"
#include "peers.h"
#include "weight_maps.h"

namespace dstylize {
namespace {

constexpr double kTolerance = 0.85;

/// Peers give other labels: then times mean nothing.
struct Disagreement : std::runtime_error {
    using std::runtime_error::runtime_error;
};

enum class Edges { weights8, planes8, planes16, falling16, irregular };

constexpr float kStipplingThreshold = 10;

/// Ratios that are to be reached: time of a peer to that of tiles with one thread and with two. 0: none.
struct Bars {
    double heap = 0, heap_by_two = 0, boost = 0, boost_by_two = 0, two_threads = 0;
};

struct Row {
    std::string map;
    Metric metric;
    Edges edges;
    Bars bars;
};

/// Nanoseconds per node; 0 where that peer does not apply.
struct Times {
    double tiles = 0, tiles_by_two = 0, bucket = 0, heap = 0, boost = 0, scissors = 0;
};

std::string_view name_of(Edges edges) {
    constexpr std::array<std::string_view, 5> kNames{"weights, 8", "planes, 8", "planes, 16", "planes, 16, falling",
                                                     "irregular, 12"};
    return kNames[std::size_t(edges)];
}

std::string name_of(const Row& row) {
    return fmt::format("{}, {}, {}", row.map, metric_names()[std::size_t(row.metric)], name_of(row.edges));
}

WeightedLattice graph_of(const Row& row, double mega) {
    const bool sixteen = row.edges == Edges::planes16 || row.edges == Edges::falling16;
    WeightedLattice g = weight_map(row.map, mega, sixteen ? Neighbourhood::square16 : Neighbourhood::square8);
    if (row.edges == Edges::weights8) return g;
    if (row.edges == Edges::irregular) {
        const Extent e = g.lattice.extent();
        g.lattice = scattered_lattice(e, Grid<std::uint8_t>(e, 1), Noise(1, Purpose::jitter), {});
        return g;
    }
    DirectionalCost cost;
    cost.strength = 1.5f;
    cost.flow = Grid<Vec2f>(g.lattice.extent(), Vec2f{0.6f, 0.5f});
    if (row.edges == Edges::falling16) cost.step_factor = downward_bias(g.lattice, 1.2f);
    build_height_planes(g, cost, {});
    return g;
}

/// The least time of so many runs, and what the last one gave.
template <class Run>
auto timed(std::size_t nodes, int times, double& nanoseconds, const Run& run) {
    nanoseconds = 1e30;
    for (;;) {
        const auto begin = std::chrono::steady_clock::now();
        auto result = run();
        const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - begin;
        nanoseconds = std::min(nanoseconds, took.count() / double(nodes));
        if (--times <= 0) return result;
    }
}

Plan planned(const Planner& planner, const WeightedLattice& g, Metric metric, int threads, int times,
             double& nanoseconds) {
    const Source source[] = {{map_source(g.lattice), 0, 0}};
    Work work;
    work.threads = threads;
    return timed(g.weight.size(), times, nanoseconds, [&] { return planner.plan({g, source, metric}, work); });
}

Times measured(const Row& row, double mega) {
    const WeightedLattice g = graph_of(row, mega);
    const std::size_t nodes = g.weight.size();
    const NodeId source = map_source(g.lattice);
    const Source sources[] = {{source, 0, 0}};
    Times t;
    const bool by_tiles = row.metric != Metric::blend;
    const int times = by_tiles ? 3 : 1;  // the rest goes to the buckets, and takes long
    const Plan plan = planned(tile_planner(), g, row.metric, 1, times, t.tiles);
    const auto check = [&](const LabelColumn& label, const char* peer) {
        if (!(label == plan.label))
            throw Disagreement(fmt::format("{} and the planner have other labels on {}", peer, name_of(row)));
    };
    check(planned(tile_planner(), g, row.metric, 2, times, t.tiles_by_two).label, "two threads");
    if (by_tiles) check(planned(bucket_planner(), g, row.metric, 1, 1, t.bucket).label, "buckets");
    check(timed(nodes, 1, t.heap, [&] { return heap_labels(g, sources, row.metric); }), "the heap");
    if (row.metric != Metric::sum || row.edges != Edges::weights8) return t;
    if (boost_is_here()) check(timed(nodes, 1, t.boost, [&] { return boost_labels(g, source); }), "Boost");
    if (row.map != "maze") timed(nodes, 1, t.scissors, [&] { return scissors_map(g, source), 0; });
    return t;
}

/// What the stippling floods on the portrait.
Grid<float> stippling_expense(const WeightedLattice& g) {
    Grid<float> expense(g.lattice.extent());
    for (std::size_t n = 0; n < expense.size(); ++n) expense[n] = float(g.weight[n]) / 255;
    return expense;
}

std::vector<NodeId> stippled(const GraphDistanceRequest& request, int threads, int times, double& nanoseconds) {
    Work work;
    work.threads = threads;
    return timed(request.expense.size(), times, nanoseconds, [&] { return graph_distance_stipples(request, work); });
}

/// The flood of the stippling; it has no peer but the heap.
Times measured_stippling(double mega, std::size_t& count) {
    const WeightedLattice g = weight_map("portrait", mega, Neighbourhood::square4);
    const Grid<float> expense = stippling_expense(g);
    const NodeId start[] = {map_source(g.lattice)};
    const GraphDistanceRequest request{expense, kStipplingThreshold, start, {}};
    Times t;
    const auto ours = stippled(request, 1, 3, t.tiles), by_two = stippled(request, 2, 3, t.tiles_by_two);
    const auto theirs = timed(expense.size(), 1, t.heap, [&] { return heap_stipples(request); });
    if (ours != theirs || ours != by_two) throw Disagreement("the heap or two threads place other stipples");
    count = ours.size();
    return t;
}

std::string machine() {
    std::ifstream cpu("/proc/cpuinfo");
    for (std::string line; std::getline(cpu, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown";
}

/// Prints rows and keeps them for the file.
class Report {
  public:
    explicit Report(double mega) : mega_(mega) {
        const unsigned threads = std::thread::hardware_concurrency();
        can_judge_two_ = threads >= 2;
        json_ = {{"machine", machine()}, {"threads", threads}, {"megapixels", mega}, {"rows", nlohmann::json::array()}};
        fmt::print("{} megapixels on {}, {} threads; nanoseconds per node, then ratios / bars\n", mega, machine(),
                   threads);
        fmt::print("{:<42}{:>7}{:>7}{:>7}{:>7}{:>7}{:>9}  {:>12}{:>12}{:>12}{:>12}{:>12}\n", "map, metric, edges",
                   "tiles", "by two", "bucket", "heap", "Boost", "scissors", "heap", "by two", "Boost", "by two",
                   "threads");
    }

    void add(const Row& row, std::string_view metric, std::string_view edges, const Times& t) {
        struct Ratio {
            const char* name;
            double of, to, bar;
            bool by_two;
        };
        const Ratio ratios[] = {{"heap", t.heap, t.tiles, row.bars.heap, false},
                                {"heap_by_two", t.heap, t.tiles_by_two, row.bars.heap_by_two, true},
                                {"boost", t.boost, t.tiles, row.bars.boost, false},
                                {"boost_by_two", t.boost, t.tiles_by_two, row.bars.boost_by_two, true},
                                {"two_threads", t.tiles, t.tiles_by_two, row.bars.two_threads, true}};
        nlohmann::ordered_json record = {
            {"map", row.map}, {"metric", metric}, {"edges", edges}, {"megapixels", mega_}, {"ns", ns_of(t)}};
        bool ok = true;
        std::string text;
        for (const Ratio& r : ratios) {
            const double ratio = r.of > 0 && r.to > 0 ? r.of / r.to : 0;
            text += fmt::format("{:>12}", ratio == 0  ? "-"
                                          : r.bar > 0 ? fmt::format("{:.3g} / {:g}", ratio, r.bar)
                                                      : fmt::format("{:.3g}", ratio));
            if (ratio == 0) continue;
            record["ratios"][r.name] = ratio;
            if (r.bar > 0) record["bars"][r.name] = r.bar;
            ok = ok && (ratio >= kTolerance * r.bar || (r.by_two && !can_judge_two_));
        }
        record["ok"] = ok;
        ok_ = ok_ && ok;
        json_["rows"].push_back(record);
        fmt::print("{:<42}{}  {}{}\n", fmt::format("{}, {}, {}", row.map, metric, edges), columns(t), text,
                   ok ? "" : "  TOO SLOW");
        std::fflush(stdout);
    }

    void write(const std::string& path) const {
        std::ofstream file(path);
        file << json_.dump(2) << '\n';
        if (!file.flush()) throw Error(ErrorCode::cannot_write, path, "cannot be written", "");
    }
    bool is_empty() const { return json_["rows"].empty(); }
    bool ok() const { return ok_; }

  private:
    static nlohmann::ordered_json ns_of(const Times& t) {
        nlohmann::ordered_json ns;
        const auto put = [&](const char* name, double time) {
            if (time > 0) ns[name] = time;
        };
        put("tiles", t.tiles), put("tiles_by_two", t.tiles_by_two), put("bucket", t.bucket);
        put("heap", t.heap), put("boost", t.boost), put("scissors", t.scissors);
        return ns;
    }
    static std::string columns(const Times& t) {
        std::string out;
        for (const double time : {t.tiles, t.tiles_by_two, t.bucket, t.heap, t.boost, t.scissors})
            out += fmt::format("{:>{}}", time > 0 ? fmt::format("{:.1f}", time) : "-", out.size() < 35 ? 7 : 9);
        return out;
    }
    double mega_;
    bool can_judge_two_ = true, ok_ = true;
    nlohmann::ordered_json json_;
};

bool compare(double mega, const std::string& only, const std::string& json) {
    constexpr Bars kSum{38, 62, 50, 80, 1.7};
    const Row rows[] = {{"portrait", Metric::sum, Edges::weights8, kSum},
                        {"noise", Metric::sum, Edges::weights8, {}},
                        {"constant", Metric::sum, Edges::weights8, {}},
                        {"maze", Metric::sum, Edges::weights8, {}},
                        {"portrait", Metric::sum, Edges::planes8, {22, 40}},
                        {"portrait", Metric::sum, Edges::planes16, {18, 30}},
                        {"portrait", Metric::sum, Edges::falling16, {}},
                        {"portrait", Metric::sum, Edges::irregular, {3}},
                        {"portrait", Metric::max_sum, Edges::weights8, {15, 28}},
                        {"noise", Metric::max_sum, Edges::weights8, {}},
                        {"portrait", Metric::max_sum, Edges::planes16, {10, 18}},
                        {"portrait", Metric::lexicographic, Edges::weights8, {12, 21}},
                        {"portrait", Metric::blend, Edges::weights8, {}}};
    if (!boost_is_here()) fmt::print("Boost is left out: libboost-graph-dev was not there when this was built\n");
    Report report(mega);
    for (const Row& row : rows)
        if (name_of(row).find(only) != std::string::npos)
            report.add(row, metric_names()[std::size_t(row.metric)], name_of(row.edges), measured(row, mega));
    if (std::string("portrait, stippling").find(only) != std::string::npos) {
        std::size_t stipples = 0;
        const Times times = measured_stippling(mega, stipples);
        report.add({"portrait", {}, {}, {3.3, 4.5}}, "stippling", fmt::format("{} points", stipples), times);
    }
    if (report.is_empty()) throw Error(ErrorCode::bad_usage, "--only " + only, "is in no row's name", "leave it out");
    report.write(json);
    return report.ok();
}

/// One row of the growth table: nanoseconds per node of `sum`, `max-sum` and stippling, by one thread and by two.
std::array<double, 6> growth_row(double mega) {
    const WeightedLattice g = weight_map("portrait", mega, Neighbourhood::square8);
    const int times = mega < 4 ? 9 : mega < 100 ? 3 : 1;
    const Grid<float> expense = stippling_expense(g);
    const NodeId start[] = {map_source(g.lattice)};
    std::array<double, 6> row{};
    for (const int threads : {1, 2}) {
        const std::size_t k = std::size_t(threads) - 1;
        planned(tile_planner(), g, Metric::sum, threads, times, row[k]);
        planned(tile_planner(), g, Metric::max_sum, threads, times, row[2 + k]);
        stippled({expense, kStipplingThreshold, start, {}}, threads, times, row[4 + k]);
    }
    return row;
}

/// How the time of a node grows with the picture; it should not.
bool show_growth(double largest) {
    constexpr std::array<double, 3> kBars{1.2, 1.4, 1.4};
    fmt::print("nanoseconds per node on the portrait, one and two threads\n{:>10} {:>15} {:>15} {:>15}\n", "megapixels",
               "sum", "max-sum", "stippling");
    std::array<double, 6> smallest{};
    bool ok = true;
    for (const double mega : {0.25, 1., 4., 24., 100., 200.}) {
        if (mega > largest) break;
        const std::array<double, 6> row = growth_row(mega);
        if (mega == 0.25) smallest = row;
        bool good = true;
        for (std::size_t k = 0; k < kBars.size(); ++k)
            good = good && (mega != 24 || row[2 * k] * kTolerance <= kBars[k] * smallest[2 * k]);
        fmt::print("{:>10} {:>7.1f}{}\n", mega, fmt::join(row, " "), good ? "" : "  TOO MUCH");
        std::fflush(stdout);
        ok = ok && good;
    }
    return ok;
}

/// For peers in other languages: weights as bytes, and beside them FILE.sums, what `sum` must come to.
void write_map(const std::string& path, const std::string& kind, double mega) {
    const WeightedLattice g = weight_map(kind, mega, Neighbourhood::square8);
    const NodeId source = map_source(g.lattice);
    write_bytes(g, path);
    std::ofstream file(path + ".sums", std::ios::binary);
    const Source sources[] = {{source, 0, 0}};
    const LabelColumn labels = heap_labels(g, sources, Metric::sum);
    for (std::size_t n = 0; n < labels.size(); ++n) {
        const auto sum = std::uint32_t(labels[n].sum);
        file.write(reinterpret_cast<const char*>(&sum), sizeof sum);
    }
    if (!file.flush()) throw Error(ErrorCode::cannot_write, path + ".sums", "cannot be written", "");
    double tiles = 0, tiles_by_two = 0;
    planned(tile_planner(), g, Metric::sum, 1, 3, tiles);
    planned(tile_planner(), g, Metric::sum, 2, 3, tiles_by_two);
    fmt::print("{} {} {} {} {} {}\n", g.lattice.extent().x, g.lattice.extent().y, g.lattice.column(source),
               g.lattice.row(source), tiles, tiles_by_two);
}

int run(int argc, char** argv) {
    CLI::App app("The tile planner beside its peers, on maps of several kinds.");
    double mega = 4, largest = 100;
    std::string json = DSTYLIZE_BENCH_JSON, only, map_file, kind = "portrait";
    app.add_option("--mega", mega, "million nodes (4)")->check(CLI::Range(0.05, 200.));
    app.add_option("--only", only, "rows whose name has this in it");
    app.add_option("--json", json, "where the figures go, too");
    app.add_option("--growth", largest, "instead: how time grows, up to so many million nodes (100)")->expected(0, 1);
    app.add_option(
        "--write-map", map_file,
        "instead: writes the weights to a file and their sums to another; prints width, height, source, and\n"
        "nanoseconds a node by one thread and by two");
    app.add_option("--map", kind, "which, for --write-map")
        ->check(CLI::IsMember({"portrait", "noise", "constant", "maze"}));
    CLI11_PARSE(app, argc, argv);
    if (!map_file.empty()) return write_map(map_file, kind, mega), 0;
    if (app.count("--growth") != 0) return show_growth(largest > 0 ? largest : 100) ? 0 : 1;
    return compare(mega, only, json) ? 0 : 1;
}

}  // namespace
}  // namespace dstylize

int main(int argc, char** argv) {
    try {
        return dstylize::run(argc, argv);
    } catch (const std::exception& e) {
        std::fputs("planner_bench: ", stderr);
        std::fputs(e.what(), stderr);
        std::fputs("\n", stderr);
        return 2;
    }
}
