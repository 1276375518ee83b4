#include <fmt/format.h>

#include <array>
#include <cstdio>

#include "graph/tile_planner.h"
#include "planner_tables.h"
#include "planner_timing.h"
#include "weight_maps.h"

namespace dstylize {
namespace {

/// Nanoseconds per node of `sum`, `max-sum` and stippling, by one thread and by two.
std::array<double, 6> growth_row(double mega) {
    const WeightedLattice g = weight_map("portrait", mega, Neighbourhood::square8);
    const int times = mega < 4 ? 9 : mega < 100 ? 3 : 2;
    const Grid<float> expense = stippling_expense(g);
    const NodeId start[] = {map_source(g.lattice)};
    const Source source[] = {{start[0], 0, 0}};
    std::array<double, 6> row{};
    for (const int threads : {1, 2}) {
        const std::size_t k = std::size_t(threads) - 1;
        planned(tile_planner(), {g, source, Metric::sum}, threads, times, row[k]);
        planned(tile_planner(), {g, source, Metric::max_sum}, threads, times, row[2 + k]);
        stippled({expense, kStipplingThreshold, start, {}}, threads, times, row[4 + k]);
    }
    return row;
}

/// The bars, which are for one thread and 24 megapixels.
bool judge_growth(const std::array<double, 6>& smallest, const std::array<double, 6>& row) {
    constexpr std::array<double, 3> kBars{1.2, 1.4, 1.4};
    bool ok = true;
    fmt::print("{:>10}", "grown by");
    for (std::size_t k = 0; k < kBars.size(); ++k) {
        const double ratio = row[2 * k] / smallest[2 * k];
        fmt::print(" {:>15}", fmt::format("{:.2f} / {:g}", ratio, kBars[k]));
        ok = ok && stays_below(ratio, kBars[k]);
    }
    fmt::print("{}\n", ok ? "" : "  TOO MUCH");
    return ok;
}

}  // namespace

bool show_growth(double largest) {
    fmt::print("nanoseconds per node on the portrait, one and two threads; from 0.25 megapixels to 24: ratio / bar\n");
    fmt::print("{:>10} {:>15} {:>15} {:>15}\n", "megapixels", "sum", "max-sum", "stippling");
    std::array<double, 6> smallest{};
    bool ok = true;
    for (const double mega : {0.25, 1., 4., 24., 100., 200.}) {
        if (mega > largest) break;
        const std::array<double, 6> row = growth_row(mega);
        fmt::print("{:>10} {:>7.1f}\n", mega, fmt::join(row, " "));
        if (mega == 0.25) smallest = row;
        if (mega == 24) ok = judge_growth(smallest, row);
        std::fflush(stdout);
    }
    return ok;
}

}  // namespace dstylize
