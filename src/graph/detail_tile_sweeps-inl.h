// Sweeps: rows relaxed one after the other, 64 edges of a kind at a time.
#if defined(DSTYLIZE_GRAPH_DETAIL_TILE_SWEEPS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef DSTYLIZE_GRAPH_DETAIL_TILE_SWEEPS_INL_H_
#undef DSTYLIZE_GRAPH_DETAIL_TILE_SWEEPS_INL_H_
#else
#define DSTYLIZE_GRAPH_DETAIL_TILE_SWEEPS_INL_H_
#endif

#include <bit>
#include <span>

#include "graph/detail_tile_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace dstylize::HWY_NAMESPACE {

struct AddCost {
    template <class V>
    static HWY_INLINE V after(V label, V cost) {
        return sum_of(label, cost);
    }
};
/// The same where the cost of an edge is the sum of two half costs: its length times the weight of either node.
struct AddHalfCosts : AddCost {};
template <class Rule>
inline constexpr bool kByHalves = std::is_same_v<Rule, AddHalfCosts>;

struct HighestEdge {
    template <class V>
    static HWY_INLINE V after(V label, V height) {
        return hn::Max(label, height);
    }
};

/// Where a sweep's edges come from: so many lanes to the left of their target (dx), so many rows back.
inline constexpr Offset kArrivals[7] = {{0, 1}, {1, 1}, {-1, 1}, {1, 2}, {-1, 2}, {2, 1}, {-2, 1}};
inline constexpr int arrivals(int steps) { return steps == 16 ? 7 : steps == 8 ? 3 : 1; }

/// For each kind of arrival the cost of the edge that ends at a node, in the node's place.
template <class Lane>
using ArrivalCosts = const Lane* [7];

/// A sweep goes down (kDown = 1) or up (-1). The step that arrives so, in a window or a transposed one.
inline std::size_t arriving_step(std::span<const Step> steps, Offset arrival, int down, bool transposed) {
    const int dx = arrival.dx, dy = arrival.dy * down;
    std::size_t s = 0;
    while (steps[s].dx != (transposed ? dy : dx) || steps[s].dy != (transposed ? dx : dy)) ++s;
    return s;
}

/// Costs are stored where edges begin, for even steps only where the other way costs as much.
template <class Rule, class Lane>
void find_arrival_costs(const TileWindow<Lane>& window, std::span<const Step> steps, bool even_only, int down,
                        bool transposed, ArrivalCosts<Lane>& costs) {
    if constexpr (kByHalves<Rule>) {
        for (int k = 0; k < 2; ++k) costs[k] = window.cost[transposed][k].data();
        return;
    }
    for (int k = 0; k < arrivals(int(steps.size())); ++k) {
        const Offset from = kArrivals[k];
        const std::size_t s = arriving_step(steps, from, down, transposed);
        costs[k] = even_only && s % 2 == 1 ? window.cost[transposed][s - 1].data()
                                           : window.cost[transposed][s].data() - (from.dy * down * kWindow + from.dx);
    }
}

template <class Rule, int kArrival, class Lane>
HWY_INLINE SweepVec<Lane> arrived(const Stretch<Lane>& from, const ArrivalCosts<Lane>& costs, int at) {
    return Rule::after(shifted<kArrivals[kArrival].dx>(from), hn::LoadU(SweepTag<Lane>(), costs[kArrival] + at));
}

#if HWY_TARGET == HWY_SCALAR
template <class Rule, int kSteps, int kDown, class Lane>
HWY_INLINE bool relax_row(const ArrivalCosts<Lane>& costs, Lane* label, int y, Lane* touched) {
    Lane differs = 0;
    const SweepTag<Lane> d;
    for (int x = 0; x < kWindow; ++x) {
        const int at = y * kWindow + x;
        const Lane old = label[at];
        Lane best = old;
        for (int k = 0; k < arrivals(kSteps); ++k) {
            const Offset from = kArrivals[k];
            if (x - from.dx < 0 || x - from.dx >= kWindow) continue;
            const int before = (y - from.dy * kDown) * kWindow + x - from.dx;
            auto after = hn::Set(d, label[before]);
            if constexpr (kByHalves<Rule>) {
                const Lane* const half = costs[k == 0 ? 0 : 1];
                after = sum_of(sum_of(after, hn::Set(d, half[before])), hn::Set(d, half[at]));
            } else {
                after = Rule::after(after, hn::Set(d, costs[k][at]));
            }
            best = std::min(best, hn::GetLane(after));
        }
        label[at] = best;
        touched[x] = Lane(touched[x] | (old ^ best));
        differs = Lane(differs | (old ^ best));
    }
    return differs != 0;
}
#else
/// Stores labels that may be lower than the old ones; marks in `touched` and `differs` the lanes that are.
template <class Lane>
HWY_INLINE void store_lowered(SweepVec<Lane> old, SweepVec<Lane> lowered, Lane* label, Lane* touched,
                              SweepVec<Lane>& differs) {
    const SweepTag<Lane> d;
    hn::Store(lowered, d, label);
    const auto fell = hn::Xor(old, lowered);
    hn::Store(hn::Or(hn::Load(d, touched), fell), d, touched);
    differs = hn::Or(differs, fell);
}

/// relax_row from two planes instead of one for each step: the half costs of straight and of diagonal edges.
template <int kSteps, int kDown, class Lane>
HWY_INLINE bool relax_row_by_halves(const ArrivalCosts<Lane>& costs, Lane* label, int y, Lane* touched) {
    const SweepTag<Lane> d;
    Lane* const row = label + y * kWindow;
    const Lane *const straight = costs[0] + y * kWindow, *const diagonal = costs[1] + y * kWindow;
    const auto half_way = [&](const Lane* half, int x) {  // from the nodes of the row before
        const int at = x - kDown * kWindow;
        return sum_of(hn::Load(d, row + at), hn::Load(d, half + at));
    };
    const auto far = hn::Set(d, kFar<Lane>);
    Stretch<Lane> a{far, far, half_way(diagonal, 0)};
    auto differs = hn::Zero(d);
    for (int x = 0; x < kWindow; x += kSweepLanes<Lane>) {
        const auto old = hn::Load(d, row + x);
        auto best = hn::Min(old, sum_of(half_way(straight, x), hn::Load(d, straight + x)));
        if constexpr (kSteps == 8) {
            const int next = x + kSweepLanes<Lane>;
            a.move_right(next < kWindow ? half_way(diagonal, next) : far);
            best = hn::Min(best, sum_of(hn::Min(shifted<1>(a), shifted<-1>(a)), hn::Load(d, diagonal + x)));
        }
        store_lowered(old, best, row + x, touched + x, differs);
    }
    return !hn::AllTrue(d, hn::Eq(differs, hn::Zero(d)));
}

/// Lowers the labels of row y by the edges that arrive at it; marks in `touched` the lanes that fell.
template <class Rule, int kSteps, int kDown, class Lane>
HWY_INLINE bool relax_row(const ArrivalCosts<Lane>& costs, Lane* label, int y, Lane* touched) {
    if constexpr (kByHalves<Rule>) return relax_row_by_halves<kSteps, kDown>(costs, label, y, touched);
    const SweepTag<Lane> d;
    Lane* const row = label + y * kWindow;
    const Lane *const one = row - kDown * kWindow, *const two = one - kDown * kWindow;
    const auto far = hn::Set(d, kFar<Lane>);
    Stretch<Lane> a{far, far, hn::Load(d, one)}, b{far, far, hn::Load(d, two)};
    auto differs = hn::Zero(d);
    for (int x = 0; x < kWindow; x += kSweepLanes<Lane>) {
        const int at = y * kWindow + x;
        a.move_right(one, x);
        const auto old = hn::Load(d, row + x);
        auto best = hn::Min(old, arrived<Rule, 0>(a, costs, at));
        if constexpr (kSteps >= 8)
            best = hn::Min(best, hn::Min(arrived<Rule, 1>(a, costs, at), arrived<Rule, 2>(a, costs, at)));
        if constexpr (kSteps == 16) {
            b.move_right(two, x);
            best = hn::Min(best, hn::Min(arrived<Rule, 3>(b, costs, at), arrived<Rule, 4>(b, costs, at)));
            best = hn::Min(best, hn::Min(arrived<Rule, 5>(a, costs, at), arrived<Rule, 6>(a, costs, at)));
        }
        store_lowered(old, best, row + x, touched + x, differs);
    }
    return !hn::AllTrue(d, hn::Eq(differs, hn::Zero(d)));
}
#endif

/// The rows that edges from these rows arrive at.
template <int kSteps, int kDown>
HWY_INLINE std::uint64_t rows_after(std::uint64_t rows) {
    const std::uint64_t one = kDown > 0 ? rows << 1 : rows >> 1;
    return kSteps < 16 ? one : one | (kDown > 0 ? rows << 2 : rows >> 2);
}

/// Relaxes the edges that leave the dirty rows downwards, and those of every row that falls on the way.
/// Returns the rows that fell.
template <class Rule, int kSteps, int kDown, class Lane>
std::uint64_t sweep(const ArrivalCosts<Lane>& costs, Lane* label, std::uint64_t dirty, Lane* touched,
                    std::uint64_t& rows_relaxed) {
    std::uint64_t waiting = rows_after<kSteps, kDown>(dirty), fell = 0;
    while (waiting != 0) {
        const int y = kDown > 0 ? std::countr_zero(waiting) : kWindow - 1 - std::countl_zero(waiting);
        const std::uint64_t bit = std::uint64_t{1} << y;
        waiting &= ~bit;
        ++rows_relaxed;
        if (!relax_row<Rule, kSteps, kDown>(costs, label, y, touched)) continue;
        fell |= bit;
        waiting |= rows_after<kSteps, kDown>(bit);
    }
    return fell;
}

/// Sweeps down and up in one orientation, then hands what fell to the other one.
/// `down` and `up`: rows whose edges are to be relaxed; on return `rows` and `columns` have those that fell.
template <class Rule, int kSteps, class Lane>
void sweep_both_ways(TileWindow<Lane>& window, const ArrivalCosts<Lane> (&costs)[2], bool transposed,
                     std::uint64_t& down, std::uint64_t& up, std::uint64_t& rows, std::uint64_t& columns,
                     std::uint64_t& rows_relaxed) {
    alignas(64) Lane touched[kWindow] = {};
    alignas(64) constexpr Lane kUntouched[kWindow] = {};
    Lane* const label = window.label[transposed].data();
    const std::uint64_t fell_down = sweep<Rule, kSteps, 1>(costs[0], label, down, touched, rows_relaxed);
    const std::uint64_t fell_up = sweep<Rule, kSteps, -1>(costs[1], label, up | fell_down, touched, rows_relaxed);
    down = fell_up;
    up = 0;
    rows = fell_down | fell_up;
    columns = rows == 0 ? 0 : lanes_below(kUntouched, touched);
    for (int y = 0; y < kWindow; y += 8)
        for (int x = 0; x < kWindow; x += 8)
            if ((rows >> y & 255) != 0 && (columns >> x & 255) != 0)
                transpose_block(label, window.label[!transposed].data(), x, y);
}

/// Brings the window's labels to rest. Returns the rows that fell.
template <class Rule, int kSteps, class Lane>
std::uint64_t settle(TileWindow<Lane>& window, const WeightedLattice& graph, bool even_only, const Pending& job,
                     std::uint64_t& rows_relaxed) {
    ArrivalCosts<Lane> costs[2][2];
    for (const bool transposed : {false, true})
        for (const int down : {1, -1})
            find_arrival_costs<Rule>(window, graph.lattice.steps(), even_only, down, transposed,
                                     costs[transposed][down < 0]);
    std::uint64_t down = job.rows, up = job.rows, right = job.columns, left = job.columns, ever = 0;
    while ((down | up | right | left) != 0) {
        std::uint64_t rows = 0, columns = 0;
        if ((down | up) != 0) {
            sweep_both_ways<Rule, kSteps>(window, costs[0], false, down, up, rows, columns, rows_relaxed);
            right |= columns;
            left |= columns;
            ever |= rows;
        }
        if ((right | left) != 0) {
            sweep_both_ways<Rule, kSteps>(window, costs[1], true, right, left, columns, rows, rows_relaxed);
            down |= rows;
            up |= rows;
            ever |= rows;
        }
    }
    return ever;
}

}  // namespace dstylize::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
