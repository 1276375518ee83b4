#include "app/report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "pipeline/version.h"

namespace dstylize::app {
namespace {

using nlohmann::ordered_json;

ordered_json extent(Extent e) { return ordered_json::array({e.x, e.y}); }

/// File names need not be UTF-8.
std::string text(const ordered_json& tree) {
    return tree.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

const char* kept_from(DecoderConfinement held) {
    if (held.system_calls && held.files) return "network, processes, all files";
    if (held.system_calls) return "network, processes, new files";
    return held.files ? "all files" : "nothing but memory over its limit: this kernel confines no process";
}

std::string input_line(const RunReport& report) {
    return fmt::format("{}: {} x {} pixels, style {}, seed {}, {} x {} nodes\n", report.input, report.picture.x,
                       report.picture.y, report.style, report.seed, report.lattice.x, report.lattice.y);
}

std::string output_lines(const RunReport& report) {
    std::string out;
    for (const OutputReport& output : report.outputs)
        out += fmt::format("{}: {}, {} x {}, {} bytes\n", output.path, output.format, output.size_px.x,
                           output.size_px.y, output.bytes);
    return out;
}

}  // namespace

std::string json_report(const RunReport& report, const Progress& progress) {
    ordered_json tree;
    tree["program"] = fmt::format("dstylize {}", version());
    tree["dry_run"] = report.dry_run;
    tree["input"] = {{"name", report.input}, {"xxh128", report.input_xxh128}, {"size_px", extent(report.picture)}};
    tree["style"] = report.style;
    tree["seed"] = report.seed;
    tree["lattice"] = extent(report.lattice);
    if (!report.dry_run) {
        tree["endpoints"] = ordered_json::object();
        for (const auto& [stage, count] : report.endpoints) tree["endpoints"][stage] = count;
        tree["unreached"] = report.unreached;
        tree["nodes"] = report.nodes;
        tree["strokes"] = report.strokes;
    }
    tree["outputs"] = ordered_json::array();
    for (const OutputReport& output : report.outputs) {
        ordered_json row{{"name", output.path}, {"format", output.format}, {"size_px", extent(output.size_px)}};
        if (!report.dry_run) row["bytes"] = output.bytes;
        row["replaced"] = output.replaced;
        tree["outputs"].push_back(row);
    }
    tree["recipe"] = report.recipe;
    tree["steps"] = ordered_json::array();
    for (const auto& [step, seconds] : progress.steps())
        tree["steps"].push_back({{"step", step}, {"seconds", seconds}});
    tree["seconds"] = progress.seconds();
    return text(tree);
}

std::string json_report(const Error& error, int exit_code) {
    ordered_json tree;
    tree["program"] = fmt::format("dstylize {}", version());
    tree["error"] = {
        {"exit_code", exit_code}, {"file", error.file()}, {"problem", error.problem()}, {"remedy", error.remedy()}};
    return text(tree);
}

std::string verbose_report(const RunReport& report, const Progress& progress) {
    std::string out = input_line(report);
    for (const auto& [step, seconds] : progress.steps()) out += fmt::format("  {:<32} {:7.3f} s\n", step, seconds);
    out += fmt::format("  {:<32} {:7.3f} s\n", "all", progress.seconds());
    if (report.decoder) out += fmt::format("  {:<32} {}\n", "the decoder was kept from", kept_from(*report.decoder));
    for (const auto& [stage, count] : report.endpoints) out += fmt::format("  {:<32} {:7} endpoints\n", stage, count);
    if (report.unreached > 0) out += fmt::format("  {:<32} {:7} endpoints\n", "not reached", report.unreached);
    if (report.nodes > 0)
        out += fmt::format("  {:<32} {:7} nodes in {} strokes\n", "drawn", report.nodes, report.strokes);
    return out + output_lines(report);
}

std::string brief_report(const RunReport& report, const Progress& progress) {
    std::string out = input_line(report) + " ";
    for (const auto& [step, seconds] : progress.steps()) out += fmt::format(" {} {:.3f},", step, seconds);
    out += fmt::format(" all {:.3f} s\n ", progress.seconds());
    for (const auto& [stage, count] : report.endpoints) out += fmt::format(" {} {} endpoints,", stage, count);
    if (report.unreached > 0) out += fmt::format(" not reached {} endpoints,", report.unreached);
    if (report.nodes > 0) out += fmt::format(" drawn {} nodes in {} strokes,", report.nodes, report.strokes);
    if (report.decoder) out += fmt::format(" the decoder was kept from {},", kept_from(*report.decoder));
    out.back() = '\n';
    return out + output_lines(report);
}

std::string dry_run_report(const RunReport& report) {
    std::string out =
        fmt::format("would draw {} ({} x {} pixels) in the style {} on {} x {} nodes with seed {}\n", report.input,
                    report.picture.x, report.picture.y, report.style, report.lattice.x, report.lattice.y, report.seed);
    for (const OutputReport& output : report.outputs)
        out += fmt::format("would {} {} as {}, {} x {}\n", output.replaced ? "replace" : "write", output.path,
                           output.format, output.size_px.x, output.size_px.y);
    return out;
}

}  // namespace dstylize::app
