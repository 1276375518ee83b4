// The tile planner with one and two threads beside the bucket planner and the readable heap, on maps of
// several kinds: nanoseconds per node, all included. Fails below 0.85 of a bar. `--json` for machines,
// `--mega N` for another size than 4 million nodes.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "graph/bucket_planner.h"
#include "graph/height_planes.h"
#include "graph/tile_planner.h"

namespace dstylize {
namespace {

/// Cheap to compute, the same everywhere.
std::uint32_t hash(std::uint32_t x, std::uint32_t y, std::uint32_t salt) {
    std::uint32_t h = x * 0x9e3779b1u ^ y * 0x85ebca77u ^ salt * 0xc2b2ae3du;
    h = (h ^ h >> 15) * 0x2c1b3c6du;
    return h ^ h >> 12;
}

/// Regions with edges, shading within them, grain: what a photograph's weights are like.
int scene(int i, int j) {
    double tone = 0;
    for (int octave = 3; octave < 9; ++octave) {
        const int cell = 1 << octave;
        const double fx = double(i % cell) / cell, fy = double(j % cell) / cell;
        const auto at = [&](int dx, int dy) {
            return double(hash(std::uint32_t(i / cell + dx), std::uint32_t(j / cell + dy), std::uint32_t(octave)) >>
                          24);
        };
        const double top = at(0, 0) + fx * (at(1, 0) - at(0, 0)), bottom = at(0, 1) + fx * (at(1, 1) - at(0, 1));
        tone += (top + fy * (bottom - top)) / 255 * std::pow(0.6, 8 - octave);
    }
    const double edges = std::fabs(std::fmod(tone * 4, 1.0) - 0.5) * 2;
    return 1 + int(200 * edges) + int(hash(std::uint32_t(i), std::uint32_t(j), 1) % 50);
}

NodeWeight map_weight(const std::string& kind, int side, int i, int j) {
    if (kind == "noise") return NodeWeight(1 + hash(std::uint32_t(i), std::uint32_t(j), 2) % 255);
    if (kind == "constant") return 100;
    if (kind == "maze") {  // corridors 6 nodes wide: each cell is open to the right or downwards
        const bool wall_x = i % 8 > 5, wall_y = j % 8 > 5, last_x = i / 8 >= side / 8 - 1,
                   last_y = j / 8 >= side / 8 - 1;
        const bool right = last_y || (!last_x && hash(std::uint32_t(i / 8), std::uint32_t(j / 8), 3) % 2 == 0);
        return (wall_x && wall_y) || (wall_x && !right) || (wall_y && right) ? kImpassable : NodeWeight{20};
    }
    return NodeWeight(std::min(255, scene(i, j)));
}

WeightedLattice map_of(const std::string& kind, int mega, Neighbourhood neighbourhood) {
    const int side = int(std::sqrt(double(mega) * 1e6));
    WeightedLattice g;
    g.lattice = Lattice({side, side}, neighbourhood);
    g.weight.resize(g.lattice.node_count());
    for (std::uint32_t n = 0; n < g.weight.size(); ++n)
        g.weight[n] = map_weight(kind, side, g.lattice.column(NodeId{n}), g.lattice.row(NodeId{n}));
    g.weight[0] = 1;
    return g;
}

/// The least of so many times.
double nanoseconds(const Planner& planner, const WeightedLattice& g, Metric metric, int threads, int times) {
    const Source source[] = {{NodeId{0}, 0, 0}};
    Work work;
    work.threads = threads;
    double least = 1e30;
    for (int k = 0; k < times; ++k) {
        const auto begin = std::chrono::steady_clock::now();
        const Plan plan = planner.plan({g, source, metric}, work);
        const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - begin;
        least = std::min(least, took.count() / double(plan.label.size()));
    }
    return least;
}

struct Row {
    std::string name, map;
    Neighbourhood neighbourhood;
    Metric metric;
    double least_ratio;  ///< to the heap, with one thread; 0: no bar
    bool planes = false, falling = false;
};

bool measure(const Row& row, int mega, bool json) {
    WeightedLattice g = map_of(row.map, mega, row.neighbourhood);
    if (row.planes) {
        DirectionalCost cost;
        cost.strength = 1.5f;
        cost.flow = Grid<Vec2f>(g.lattice.extent(), Vec2f{0.6f, 0.5f});
        if (row.falling) cost.step_factor = downward_bias(g.lattice, 1.2f);
        build_height_planes(g, cost, {});
    }
    const double one = nanoseconds(tile_planner(), g, row.metric, 1, 3);
    const double two = nanoseconds(tile_planner(), g, row.metric, 2, 3);
    const double bucket = nanoseconds(bucket_planner(), g, row.metric, 1, 1);
    const double heap = nanoseconds(reference_planner(), g, row.metric, 1, 1);
    const bool ok = heap / one >= 0.85 * row.least_ratio;
    const char* format = json ? "{\"map\":\"%s\",\"tiles\":%.1f,\"tiles2\":%.1f,\"bucket\":%.1f,\"heap\":%.1f,"
                                "\"ratio\":%.1f,\"bar\":%.0f,\"ok\":%s}\n"
                              : "%-32s %8.1f %8.1f %8.1f %8.1f %7.1f %6.0f  %s\n";
    std::printf(format, row.name.c_str(), one, two, bucket, heap, heap / one, row.least_ratio,
                json ? (ok ? "true" : "false") : (ok ? "" : "TOO SLOW"));
    std::fflush(stdout);
    return ok;
}

}  // namespace
}  // namespace dstylize

int main(int argc, char** argv) {
    using namespace dstylize;
    bool json = false, ok = true;
    int mega = 4;
    for (int k = 1; k < argc; ++k) {
        const std::string argument = argv[k];
        if (argument == "--json") json = true;
        if (argument == "--mega" && k + 1 < argc) mega = std::atoi(argv[k + 1]);
    }
    constexpr Neighbourhood k8 = Neighbourhood::square8, k16 = Neighbourhood::square16;
    const Row rows[] = {{"sum, scene", "scene", k8, Metric::sum, 38},
                        {"sum, noise", "noise", k8, Metric::sum, 0},
                        {"sum, constant", "constant", k8, Metric::sum, 0},
                        {"sum, maze", "maze", k8, Metric::sum, 0},
                        {"sum, 8 planes", "scene", k8, Metric::sum, 22, true},
                        {"sum, 16 planes", "scene", k16, Metric::sum, 18, true},
                        {"sum, 16 planes, falling", "scene", k16, Metric::sum, 0, true, true},
                        {"max-sum, scene", "scene", k8, Metric::max_sum, 15},
                        {"max-sum, 16 planes", "scene", k16, Metric::max_sum, 10, true}};
    if (!json)
        std::printf("ns per node, %d million nodes\n%-32s %8s %8s %8s %8s %7s %6s\n", mega, "", "tiles", "2 thr.",
                    "bucket", "heap", "heap/1", "bar");
    for (const Row& row : rows) ok = measure(row, mega, json) && ok;
    return ok ? 0 : 1;
}
