// The passes of detail_tiles.h, compiled for each instruction set. Vectors of unknown length do not fit into
// arrays: machines that have them take the next best; and AVX3_DL has nothing that is needed.
#define HWY_DISABLED_TARGETS (HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "graph/tile_passes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <limits>
#include <type_traits>

#include "graph/detail_tile_costs-inl.h"
#include "graph/detail_tile_forest_parents-inl.h"
#include "graph/detail_tile_half_parents-inl.h"
#include "graph/detail_tile_parents-inl.h"
#include "graph/detail_tile_sift-inl.h"
#include "graph/detail_tile_sweeps-inl.h"
#include "graph/detail_tile_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace dstylize::HWY_NAMESPACE {

/// The labels that a rule is about.
template <class Rule>
auto* labels_of(const TileProblem& problem) {
    if constexpr (std::is_same_v<HighestEdge, Rule>)
        return problem.bottleneck.data();
    else
        return problem.sum.data();
}

template <class Rule, class Lane>
void load_labels(const TileProblem& problem, int tile, std::uint32_t base, TileWindow<Lane>& window) {
    Lane* const label = window.label[0].data();
    const auto* const from = labels_of<Rule>(problem);
    using Label = std::remove_cvref_t<decltype(*from)>;
    WindowRows<Label> rows(problem.graph.lattice, problem.tiling, tile, std::numeric_limits<Label>::max());
    for (int y = 0; y < kWindow; ++y) load_row_above(rows(from, y), base, label + y * kWindow);
    std::copy_n(label, kWindowNodes, window.before.data());
    transpose(label, window.label[1].data());
}

/// Writes the lanes of `fell` back. Whole vectors where the window is inside the lattice: others' nodes
/// in the same row must not be touched.
template <class Lane, class Label>
HWY_INLINE void store_row(const Lane* now, const Lane* before, std::uint32_t base, std::uint64_t fell, bool inside,
                          Label* label) {
    if (!inside) {
        for (; fell != 0; fell &= fell - 1) {
            const int x = std::countr_zero(fell);
            label[x] = Label(base + now[x]);
        }
        return;
    }
    const Tag<Label> d;
    const hn::Rebind<Lane, decltype(d)> half;
    for (int x = 0; x < kWindow; x += kLanes<Label>) {
        const auto lanes = hn::LoadU(half, now + x), old = hn::LoadU(half, before + x);
        if constexpr (sizeof(Lane) == sizeof(Label)) {
            hn::BlendedStore(hn::Add(lanes, hn::Set(d, Label(base))), hn::Lt(lanes, old), d, label + x);
        } else {
            const auto wide = hn::PromoteTo(d, lanes);
            hn::BlendedStore(hn::Add(wide, hn::Set(d, base)), hn::Lt(wide, hn::PromoteTo(d, old)), d, label + x);
        }
    }
}

template <class Lane>
void add_lanes(Pending& pending, const Lane* now, std::uint32_t base, std::uint64_t lanes, std::uint64_t row,
               int columns_left) {
    if (lanes == 0) return;
    Lane least = kFar<Lane>, largest = 0;
    for (std::uint64_t rest = lanes; rest != 0; rest &= rest - 1) {
        const Lane label = now[std::countr_zero(rest)];
        least = std::min(least, label);
        largest = std::max(largest, label);
    }
    pending.add(base + least, base + largest, row, columns_left >= 0 ? lanes << columns_left : lanes >> -columns_left);
}

/// Hands on how many bits the next visits need.
inline void mark_steep(const TileProblem& problem, std::uint32_t base, TileVisit& visit) {
    const bool steep = std::any_of(visit.after.begin(), visit.after.end(),
                                   [&](const Pending& p) { return p.any() && problem.is_steep(base, p.largest); });
    for (Pending& p : visit.after) p.steep = steep;
}

/// Writes back what fell and tells the tile that a node belongs to: rim nodes are the neighbours', and
/// of the tile's own those wait for another visit whose edges end beyond what this one could see.
template <class Rule, class Lane>
void write_back(const TileProblem& problem, const TileWindow<Lane>& window, std::uint32_t base, std::uint64_t rows,
                TileVisit& visit) {
    const Tiling& tiling = problem.tiling;
    const int rim = tiling.rim(), side = tiling.side(), width = problem.graph.lattice.extent().x;
    const bool inside = tiling.is_inside(visit.tile);
    const Offset origin = tiling.origin(visit.tile);
    const std::uint64_t left = (std::uint64_t{1} << rim) - 1, right = left << (kWindow - rim);
    const Lane seen = Lane(kFar<Lane> - problem.largest_step);
    for (; rows != 0; rows &= rows - 1) {
        const int y = std::countr_zero(rows);
        const Lane *const now = window.label[0].data() + y * kWindow, *const before =
                                                                          window.before.data() + y * kWindow;
        const std::uint64_t fell = lanes_below(now, before);
        if (fell == 0) continue;
        const std::ptrdiff_t begin = std::ptrdiff_t(origin.dy + y) * width + origin.dx;
        store_row(now, before, base, fell, inside, labels_of<Rule>(problem) + begin);
        const int band = y < rim ? 0 : y < kWindow - rim ? 1 : 2;
        const std::uint64_t row = std::uint64_t{1} << (y + (1 - band) * side);
        Pending* const beside = &visit.after[std::size_t(3 * band)];
        add_lanes(beside[0], now, base, fell & left, row, side);
        add_lanes(beside[2], now, base, fell & right, row, -side);
        std::uint64_t middle = fell & ~(left | right);
        if (band == 1) middle &= problem.largest_step == 0 ? 0 : lanes_above(now, Lane(seen - 1));
        add_lanes(beside[1], now, base, middle, row, 0);
    }
    const Pending& job = visit.job;
    if (problem.rule != TileRule::bottleneck && job.largest >= base + seen && job.largest > base)
        visit.after[4].add(base + seen, job.largest, job.rows, job.columns);
    if (problem.rule != TileRule::bottleneck) mark_steep(problem, base, visit);
}

template <class Rule, int kSteps, class Lane>
void visit_window(const TileProblem& problem, TileWindow<Lane>& window, TileVisit& visit) {
    const std::uint32_t base = problem.rule == TileRule::bottleneck ? 0 : visit.job.least;
    const WeightedLattice& g = problem.graph;
    const bool even_only = problem.rule != TileRule::sum_within_bottleneck && problem.symmetric();
    load_labels<Rule>(problem, visit.tile, base, window);
    if constexpr (kByHalves<Rule>)
        load_half_costs<kSteps>(problem, visit.tile, window);
    else
        load_costs(problem, visit.tile, even_only, window);
    const std::uint64_t rows = settle<Rule, kSteps>(window, g, even_only, visit.job, visit.rows_relaxed);
    write_back<Rule>(problem, window, base, rows, visit);
}

template <class Rule, class Lane>
void visit_lattice(const TileProblem& problem, std::unique_ptr<TileWindow<Lane>>& window, TileVisit& visit) {
    if (window == nullptr) {
        window = std::make_unique<TileWindow<Lane>>();
        for (auto& label : window->label) std::fill(std::begin(label.lanes), std::end(label.lanes), kFar<Lane>);
    }
    switch (problem.graph.lattice.neighbourhood()) {
        case Neighbourhood::square4: return visit_window<Rule, 4>(problem, *window, visit);
        case Neighbourhood::square8: return visit_window<Rule, 8>(problem, *window, visit);
        case Neighbourhood::square16:
            if constexpr (!kByHalves<Rule>) visit_window<Rule, 16>(problem, *window, visit);
    }
}

/// Not with planes of heights, and not where an edge passes between nodes.
bool has_half_costs(const TileProblem& problem) {
    return problem.rule == TileRule::sum && problem.graph.height_plane.empty() &&
           problem.graph.lattice.neighbourhood() != Neighbourhood::square16;
}

void visit_tile(const TileProblem& problem, TileScratch& scratch, TileVisit& visit) {
    if (problem.rule == TileRule::bottleneck) return visit_lattice<HighestEdge>(problem, scratch.narrow, visit);
    const bool wide = problem.takes_wide_lanes(visit.job);
    if (has_half_costs(problem))
        return wide ? visit_lattice<AddHalfCosts>(problem, scratch.wide, visit)
                    : visit_lattice<AddHalfCosts>(problem, scratch.narrow, visit);
    if (wide) return visit_lattice<AddCost>(problem, scratch.wide, visit);
    visit_lattice<AddCost>(problem, scratch.narrow, visit);
}

/// For narrow costs; kBoth: halves of labels, else the low ones.
template <bool kPlanes>
void half_parents(const ParentRow& r, bool both, const HalfRows& halves, const StepOrder& order, std::uint8_t* out) {
    if (r.bottleneck != nullptr) return half_parents_of_row<true, kPlanes, true>(r, halves, order, out);
    both ? half_parents_of_row<false, kPlanes, true>(r, halves, order, out)
         : half_parents_of_row<false, kPlanes, false>(r, halves, order, out);
}

template <bool kPlanes>
void parents_of_rows(const ParentRequest& request, int first_row, int end_row, std::uint8_t* step) {
    const WeightedLattice& graph = request.graph;
    const Extent e = graph.lattice.extent();
    const StepOrder order(graph.lattice.steps());
    const std::uint16_t* const bottleneck = request.bottleneck.empty() ? nullptr : request.bottleneck.data();
    const bool by_halves = request.largest_step <= kLargestHalfCost;
    const bool both = bottleneck != nullptr || (kPlanes && !graph.symmetric) || request.largest_step > kLargestLowCost;
    HalfRows halves(by_halves ? e.x : 0, both);
    int loaded = std::max(0, first_row - kReach);
    for (int j = first_row; j < end_row; ++j) {
        const ParentRow row{graph, request.sum.data(), bottleneck, j};
        std::uint8_t* const out = step + std::size_t(j) * std::size_t(e.x);
        if (by_halves) {
            for (; loaded < std::min(e.y, j + kReach + 1); ++loaded) halves.load(row.sum, loaded);
            half_parents<kPlanes>(row, both, halves, order, out);
        } else {
            bottleneck != nullptr ? parents_of_row<true, kPlanes>(row, order, out)
                                  : parents_of_row<false, kPlanes>(row, order, out);
        }
    }
}

void find_parents(const ParentRequest& request, int first_row, int end_row, std::uint8_t* step) {
    request.graph.height_plane.empty() ? parents_of_rows<false>(request, first_row, end_row, step)
                                       : parents_of_rows<true>(request, first_row, end_row, step);
}

std::uint16_t largest_value(const std::uint16_t* values, std::size_t count) {
    const Tag<std::uint16_t> d;
    constexpr std::size_t kAtOnce = kLanes<std::uint16_t>;
    auto largest = hn::Zero(d);
    std::size_t n = 0;
    for (; n + kAtOnce <= count; n += kAtOnce) largest = hn::Max(largest, hn::LoadU(d, values + n));
    std::uint16_t lanes[kAtOnce], best = 0;
    hn::StoreU(largest, d, lanes);
    for (const std::uint16_t lane : lanes) best = std::max(best, lane);
    for (; n < count; ++n) best = std::max(best, values[n]);
    return best;
}

}  // namespace dstylize::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dstylize {

HWY_EXPORT(visit_tile);
HWY_EXPORT(find_parents);
HWY_EXPORT(find_forest_parents);
HWY_EXPORT(sift_tile);
HWY_EXPORT(walk_on);
HWY_EXPORT(largest_value);

TileScratch::TileScratch() = default;
TileScratch::~TileScratch() = default;

void visit_tile(const TileProblem& problem, TileScratch& scratch, TileVisit& visit) {
    HWY_DYNAMIC_DISPATCH(visit_tile)(problem, scratch, visit);
}

void find_parents(const ParentRequest& request, int first_row, int end_row, std::span<std::uint8_t> step) {
    HWY_DYNAMIC_DISPATCH(find_parents)(request, first_row, end_row, step.data());
}

bool find_forest_parents(const Lattice& lattice, std::span<const std::uint32_t> sum, int first_row, int end_row,
                         std::span<std::uint8_t> step) {
    return HWY_DYNAMIC_DISPATCH(find_forest_parents)(lattice, sum.data(), first_row, end_row, step.data());
}

void sift_tile(const WeightedLattice& graph, const Tiling& tiling, int tile,
               std::span<const std::uint64_t, kWindow> sources, SiftedTile& sifted) {
    HWY_DYNAMIC_DISPATCH(sift_tile)(graph, tiling, tile, sources, sifted);
}

bool walk_on(const WalkGround& ground, UnsetVector<WalkedNode>& node, Frontier& frontier) {
    return HWY_DYNAMIC_DISPATCH(walk_on)(ground, node.data(), frontier);
}

std::uint16_t largest_value(std::span<const std::uint16_t> values) {
    return HWY_DYNAMIC_DISPATCH(largest_value)(values.data(), values.size());
}

}  // namespace dstylize
#endif
