// Least-cost paths at the speed of memory.
//
// The lattice is cut into tiles. A visit to a tile copies its window of 64 x 64 labels, as 16- or 32-bit
// differences from the smallest label that is pending there, and relaxes rows until nothing falls: a
// sweep down lowers each row by all edges that arrive from above, 64 at a time, but only where a row
// above fell; then up; then the same on the transposed window for right and left. What fell is
// written back. Nodes of the rim belong to the neighbours: those that fell are pending there. The tile
// with the smallest pending label is visited next, so labels come to rest in nearly the order in which
// best-first search would settle them, and a tile is visited one to three times.
//
// It is exact whatever the order of visits: a label is always the cost of some path, it only falls, and
// whenever one falls, all edges that leave its node are relaxed later. Three things need care:
//   - Labels below the smallest pending one become 0. They have been relaxed with that value, and nothing
//     that is pending can lower them.
//   - Labels too far above it become "far". If they are pending, or fell to where an edge would end out of
//     sight, the tile is visited again, with a later base.
//   - Edges that do not exist are as dear as "far", and sums stop there; so masks and the border of
//     the lattice need no thought.
//
// An edge over node weights costs the sum of two half costs, one of each node; `sum` then loads two planes of
// these, for straight and diagonal steps, instead of one plane for each step.
//
// `max-sum` takes two passes: first the bottlenecks M, the same with maxima instead of sums; then the
// sums over those edges u -> v alone for which max(M(u), h) = M(v). Its labels rank M first, so that a
// node's M never depends on sums, and this is what best-first search with that order finds.
//
// Parents follow from labels at rest, row by row; owners from parents.
//
// Two more methods go by tiles: spanning_forest.cpp for `lexicographic`, listed_search.cpp for irregular lattices.
#include "graph/tile_planner.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "graph/bucket_planner.h"
#include "graph/detail_listed_search.h"
#include "graph/detail_owners.h"
#include "graph/detail_sources.h"
#include "graph/detail_spanning_forest.h"
#include "graph/detail_tile_queue.h"
#include "graph/detail_tiles.h"
#include "graph/detail_workers.h"

namespace dstylize {
namespace {

constexpr std::uint32_t kLargestBottleneck = 65534;
/// Above that 16-bit windows see too few steps ahead.
constexpr std::uint32_t kLargestNarrowStep = 20000;

/// The highest edge that there can be, and the longest step.
struct EdgeBounds {
    std::uint32_t height = 0, length5 = 0;
    std::uint32_t cost() const { return height * length5; }
};

EdgeBounds edge_bounds(const WeightedLattice& g) {
    EdgeBounds bounds;
    for (const Step s : g.lattice.steps()) bounds.length5 = std::max(bounds.length5, std::uint32_t(s.length5));
    for (const auto& plane : g.height_plane)
        bounds.height = std::max(bounds.height, std::uint32_t(largest_value(plane)));
    if (g.height_plane.empty()) bounds.height = 2 * std::uint32_t(largest_value(g.weight));
    return bounds;
}

/// Brings the labels to rest after those of some sources fell. False if they do not fit.
bool settle_labels(const TileProblem& problem, const std::vector<Source>& sources, const Work& work, TileStats& stats) {
    const Lattice& lattice = problem.graph.lattice;
    const Tiling& tiling = problem.tiling;
    const int workers = std::min(thread_count(work), tiling.count());
    TileQueue queue(tiling, workers, problem.rule == TileRule::bottleneck ? 8 : 65536);
    for (const Source& s : sources) {
        const int i = lattice.column(s.node), j = lattice.row(s.node), tile = tiling.tile_of(i, j);
        const Offset origin = tiling.origin(tile);
        const std::uint32_t label = problem.label(s.node);
        Pending pending;
        pending.add(label, label, std::uint64_t{1} << (j - origin.dy), std::uint64_t{1} << (i - origin.dx));
        queue.add(tile, pending);
    }
    std::atomic<bool> fits{true};
    std::atomic<std::uint64_t> visits{0}, rows{0};
    run_workers(workers, [&](int worker) {
        TileScratch scratch;
        std::uint64_t own_visits = 0, own_rows = 0;
        while (auto visit = queue.take(worker)) {
            if (visit->job.least > problem.largest_base()) fits = false;
            if (!fits || work.stop.stop_requested()) {
                queue.abandon();
                break;
            }
            visit_tile(problem, scratch, *visit);
            ++own_visits;
            own_rows += visit->rows_relaxed;
            queue.finish(*visit);
        }
        visits += own_visits;
        rows += own_rows;
    });
    work.check();
    stats.visits += visits;
    stats.rows_relaxed += rows;
    return fits;
}

/// Labels to begin with: those of an earlier plan, if there are any, else none.
template <class Label>
UnsetVector<Label> first_labels(std::size_t nodes, std::span<const Label> earlier, const Work& work) {
    UnsetVector<Label> label(nodes);
    share_out(nodes, work, [&](std::size_t first, std::size_t end) {
        const auto out = label.begin() + std::ptrdiff_t(first);
        if (earlier.size() == nodes)
            std::copy_n(earlier.begin() + std::ptrdiff_t(first), end - first, out);
        else
            std::fill_n(out, end - first, std::numeric_limits<Label>::max());
    });
    return label;
}

/// Gives the sources their labels; those that fell by it.
template <class Label, class LabelOf>
std::vector<Source> fallen(const std::vector<Source>& sources, UnsetVector<Label>& label, LabelOf label_of) {
    std::vector<Source> out;
    for (const Source& s : sources) {
        if (label_of(s) >= label[index(s.node)]) continue;
        label[index(s.node)] = label_of(s);
        out.push_back(s);
    }
    return out;
}

ParentColumn parents(const WeightedLattice& g, std::span<const std::uint32_t> sum,
                     std::span<const std::uint16_t> bottleneck, std::uint32_t largest_step,
                     const std::vector<Source>& sources, const Work& work) {
    UnsetVector<std::uint8_t> step(sum.size());
    share_out(std::size_t(g.lattice.extent().y), work, [&](std::size_t first, std::size_t end) {
        find_parents({g, sum, bottleneck, largest_step}, int(first), int(end), step);
    });
    for (const Source& s : sources)
        if (sum[index(s.node)] == s.start && (bottleneck.empty() || bottleneck[index(s.node)] == 0))
            step[index(s.node)] = ParentColumn::kNoStep;
    return {g.lattice, std::move(step)};
}

/// The plan by tiles, or nothing where they do not serve.
std::optional<Plan> tiled(const PlanRequest& request, const Work& work, TileStats& stats) {
    const WeightedLattice& g = request.graph;
    const bool has_bottlenecks = request.metric == Metric::max_sum;
    if (request.metric == Metric::blend || request.turn_penalty > 0) return {};
    if (g.lattice.adjacency() && request.metric != Metric::sum) return {};
    const std::vector<Source> sources = distinct_sources(request);
    if (g.lattice.adjacency()) return plan_listed(request, sources, work, stats);
    const EdgeBounds bounds = edge_bounds(g);
    if (request.metric == Metric::lexicographic) {
        stats.tiles = std::uint64_t(Tiling(g.lattice).count());
        return plan_spanning_forest(request, sources, bounds.height, work);
    }
    const bool wide = bounds.cost() > kLargestNarrowStep;
    if (has_bottlenecks && bounds.height > kLargestBottleneck) return {};

    const Plan* const earlier = reusable_plan(request, sources);
    const std::size_t nodes = g.lattice.node_count();
    const Tiling tiling(g.lattice);
    UnsetVector<std::uint16_t> bottleneck;
    if (has_bottlenecks) {
        std::span<const std::uint16_t> before;
        if (earlier != nullptr) before = earlier->label.highest();
        bottleneck = first_labels(nodes, before, work);
        const auto start = [](const Source&) { return std::uint16_t{0}; };
        const std::vector<Source> first = fallen(sources, bottleneck, start);
        settle_labels({g, tiling, TileRule::bottleneck, false, 0, {}, bottleneck}, first, work, stats);
    }
    const TileRule rule = has_bottlenecks ? TileRule::sum_within_bottleneck : TileRule::sum;
    std::span<const std::uint32_t> sums_before;
    if (earlier != nullptr && !has_bottlenecks) sums_before = earlier->label.sums();
    UnsetVector<std::uint32_t> sum = first_labels(nodes, sums_before, work);
    const TileProblem sums{g, tiling, rule, wide, bounds.cost(), sum, bottleneck};
    for (const Source& s : sources)
        if (s.start > sums.largest_base()) return {};
    const auto start = [](const Source& s) { return std::uint32_t(s.start); };
    if (!settle_labels(sums, fallen(sources, sum, start), work, stats)) return {};
    stats.tiles = std::uint64_t(tiling.count());
    ParentColumn parent = parents(g, sum, bottleneck, bounds.cost(), sources, work);
    OwnerColumn owner = owners_by_parents(parent, sources, work);
    return Plan{{std::move(sum), std::move(bottleneck)}, std::move(parent), std::move(owner)};
}

class TilePlanner final : public Planner {
  public:
    Plan plan(const PlanRequest& request, const Work& work) const override {
        TileStats stats;
        return plan_by_tiles(request, work, stats);
    }
};

}  // namespace

Plan plan_by_tiles(const PlanRequest& request, const Work& work, TileStats& stats) {
    work.check();
    if (std::optional<Plan> plan = tiled(request, work, stats)) return *std::move(plan);
    stats = {};
    return bucket_planner().plan(request, work);
}

const Planner& tile_planner() {
    static const TilePlanner planner;
    return planner;
}

}  // namespace dstylize
