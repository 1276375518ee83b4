// The tile planner with one and two threads beside its peers, on maps of several kinds: nanoseconds per node, all
// included; and how its time and memory grow. Labels must be equal, or it exits with 2; below 0.85 of a bar it exits
// with 1.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "core/error.h"
#include "graph/tile_planner.h"
#include "peers.h"
#include "planner_report.h"
#include "planner_rows.h"
#include "planner_tables.h"
#include "planner_timing.h"
#include "weight_maps.h"

namespace dstylize {
namespace {

std::vector<Row> rows() {
    using enum Edges;
    using enum Starts;
    return {{"portrait", Metric::sum, weights8, {38, 62, 50, 80}},
            {"noise", Metric::sum, weights8},
            {"constant", Metric::sum, weights8},
            {"maze", Metric::sum, weights8},
            {"discs", Metric::sum, weights8},
            {"65535 levels", Metric::sum, weights8},
            {"portrait", Metric::sum, weights8, {}, owners100},
            {"portrait", Metric::sum, weights8, {}, owners1000},
            {"portrait", Metric::sum, weights8, {}, grown},
            {"portrait", Metric::sum, weights8, {}, grown, true},
            {"portrait", Metric::sum, weights8, {}, carried},
            {"portrait", Metric::sum, weights8, {}, carried, true},
            {"portrait", Metric::sum, weights8, {}, grown_twice},
            {"portrait", Metric::sum, weights8, {}, grown_twice, true},
            {"portrait", Metric::sum, planes8, {22, 40}},
            {"portrait", Metric::sum, planes16, {18, 30}},
            {"portrait", Metric::sum, falling16},
            {"portrait", Metric::sum, irregular, {3}},
            {"portrait", Metric::max_sum, weights8, {15, 28}},
            {"noise", Metric::max_sum, weights8},
            {"32767 levels", Metric::max_sum, weights8},
            {"65535 levels", Metric::max_sum, weights8},
            {"portrait", Metric::max_sum, weights8, {}, grown_twice},
            {"portrait", Metric::max_sum, weights8, {}, grown_twice, true},
            {"portrait", Metric::max_sum, planes16, {10, 18}},
            {"portrait", Metric::lexicographic, weights8, {12, 21}},
            {"portrait", Metric::lexicographic, irregular},
            {"portrait", Metric::blend, weights8},
            {"portrait", Metric::blend, irregular}};
}

bool compare(double mega, const std::string& only, const std::string& json) {
    constexpr double kTwoThreads = 1.7;
    if (!boost_is_here()) fmt::print("Boost is left out: libboost-graph-dev was not there when this was built\n");
    Report report(mega);
    for (const Row& row : rows())
        if (name_of(row).find(only) != std::string::npos) report.add(row, measured(row, mega));
    if (std::string("portrait, stippling").find(only) != std::string::npos) {
        std::size_t points = 0;
        const Times times = measured_stippling(mega, points);
        report.add_stippling(times, points, {3.3, 4.5});
    }
    if (report.is_empty()) throw Error(ErrorCode::bad_usage, "--only " + only, "is in no row's name", "leave it out");
    report.finish(only.empty() ? kTwoThreads : 0);
    report.write(json);
    return report.ok();
}

/// For peers in other languages: weights as bytes, and beside them FILE.sums, what `sum` must come to.
void write_map(const std::string& path, const std::string& kind, double mega) {
    const WeightedLattice g = weight_map(kind, mega, Neighbourhood::square8);
    const Source source[] = {{map_source(g.lattice), 0, 0}};
    write_bytes(g, path);
    std::ofstream file(path + ".sums", std::ios::binary);
    const LabelColumn labels = heap_labels(g, source, Metric::sum);
    for (std::size_t n = 0; n < labels.size(); ++n) {
        const auto sum = std::uint32_t(labels[n].sum);
        file.write(reinterpret_cast<const char*>(&sum), sizeof sum);
    }
    if (!file.flush()) throw Error(ErrorCode::cannot_write, path + ".sums", "cannot be written", "");
    double tiles = 0, tiles_by_two = 0;
    planned(tile_planner(), {g, source, Metric::sum}, 1, 3, tiles);
    planned(tile_planner(), {g, source, Metric::sum}, 2, 3, tiles_by_two);
    const Lattice& lattice = g.lattice;
    fmt::print("{} {} {} {} {} {}\n", lattice.extent().x, lattice.extent().y, lattice.column(source[0].node),
               lattice.row(source[0].node), tiles, tiles_by_two);
}

int run(int argc, char** argv) {
    CLI::App app("The tile planner beside its peers, on maps of several kinds.");
    double mega = 4, largest = 100, memory = 24;
    std::string json = DSTYLIZE_BENCH_JSON, only, map_file, kind = "portrait";
    app.add_option("--mega", mega, "million nodes (4)")->check(CLI::Range(0.05, 200.));
    app.add_option("--only", only, "rows whose name has this in it");
    app.add_option("--json", json, "where the figures go, too");
    app.add_option("--growth", largest, "instead: how time grows, up to so many million nodes (100)")->expected(0, 1);
    app.add_option("--memory", memory, "instead: what a plan of so many million nodes holds at its peak (24)")
        ->expected(0, 1);
    app.add_option(
        "--write-map", map_file,
        "instead: writes the weights to a file and their sums to another; prints width, height, source, and\n"
        "nanoseconds a node by one thread and by two");
    app.add_option("--map", kind, "which, for --write-map")
        ->check(CLI::IsMember({"portrait", "discs", "noise", "constant", "maze"}));
    CLI11_PARSE(app, argc, argv);
    if (!map_file.empty()) return write_map(map_file, kind, mega), 0;
    if (app.count("--growth") != 0) return show_growth(largest > 0 ? largest : 100) ? 0 : 1;
    if (app.count("--memory") != 0) return show_memory(memory > 0 ? memory : 24) ? 0 : 1;
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
