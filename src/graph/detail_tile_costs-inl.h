// The edges of a window: heights from node weights or height planes, and what they add to a label.
#if defined(DSTYLIZE_GRAPH_DETAIL_TILE_COSTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef DSTYLIZE_GRAPH_DETAIL_TILE_COSTS_INL_H_
#undef DSTYLIZE_GRAPH_DETAIL_TILE_COSTS_INL_H_
#else
#define DSTYLIZE_GRAPH_DETAIL_TILE_COSTS_INL_H_
#endif

#include <algorithm>
#include <span>

#include "graph/detail_tile_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace dstylize::HWY_NAMESPACE {

/// Row y of a tile's window in a plane over the lattice: where it lies or, if it reaches out, a copy.
template <class T>
class WindowRows {
  public:
    WindowRows(const Lattice& lattice, const Tiling& tiling, int tile, T outside)
        : extent_(lattice.extent()), origin_(tiling.origin(tile)), outside_(outside) {}

    const T* operator()(const T* plane, int y) { return at_origin(plane, y, {0, 0, 0}); }
    /// Only of nodes that are in the lattice with the ones that `step` leads to.
    const T* with_step(const T* plane, int y, Step step) { return at_origin(plane, y, step); }
    /// For those nodes what the plane has of the ones that `step` leads to.
    const T* where_it_leads(const T* plane, int y, Step step) {
        return at_origin(plane + (std::ptrdiff_t(step.dy) * extent_.x + step.dx), y, step);
    }

  private:
    const T* at_origin(const T* plane, int y, Step step) {
        const int j = origin_.dy + y;
        const int top = std::max(0, -int(step.dy)), bottom = std::min(extent_.y, extent_.y - step.dy);
        const int left = std::max(0, -int(step.dx)), right = std::min(extent_.x, extent_.x - step.dx);
        const std::ptrdiff_t begin = std::ptrdiff_t(j) * extent_.x + origin_.dx;
        const bool row_is_inside = j >= top && j < bottom;
        if (row_is_inside && origin_.dx >= left && origin_.dx + kWindow <= right) return plane + begin;
        std::fill_n(copy_, kWindow, outside_);
        const int first = std::max(0, left - origin_.dx), end = std::min(kWindow, right - origin_.dx);
        if (row_is_inside && first < end) std::copy_n(plane + (begin + first), end - first, copy_ + first);
        return copy_;
    }

    Extent extent_;
    Offset origin_;
    T outside_;
    alignas(64) T copy_[kWindow];
};

HWY_INLINE Vec<std::uint16_t> lanes_from(Tag<std::uint16_t> d, const std::uint16_t* p) { return hn::LoadU(d, p); }
HWY_INLINE Vec<std::uint32_t> lanes_from(Tag<std::uint32_t> d, const std::uint16_t* p) {
    return hn::PromoteTo(d, hn::LoadU(hn::Rebind<std::uint16_t, decltype(d)>(), p));
}

/// Labels above `base`: 0 for those below it, far for those out of reach.
template <class Lane>
void load_row_above(const std::uint32_t* label, std::uint32_t base, Lane* row) {
    const Tag<std::uint32_t> d;
    const auto from = hn::Set(d, base), far = hn::Set(d, std::uint32_t{kFar<Lane>});
    for (int x = 0; x < kWindow; x += kLanes<std::uint32_t>) {
        const auto lanes = hn::Min(hn::Sub(hn::Max(hn::LoadU(d, label + x), from), from), far);
        if constexpr (sizeof(Lane) == 4) {
            hn::Store(lanes, d, row + x);
        } else {
            const hn::Rebind<std::uint16_t, decltype(d)> half;
            hn::StoreU(hn::DemoteTo(half, hn::BitCast(hn::RebindToSigned<decltype(d)>(), lanes)), half, row + x);
        }
    }
}

/// Heights of the edges that leave 64 nodes by a step, from node weights; 0 where there is none.
template <class Lane>
HWY_INLINE Vec<Lane> height_from_weights(const Lane* weight, Step step) {
    const Tag<Lane> d;
    const auto a = hn::Load(d, weight), b = hn::LoadU(d, weight + step.dy * kWindow + step.dx);
    auto least = hn::Min(a, b), height = hn::Add(a, b);
    if (is_knights_move(step)) {
        for (const Offset o : passed_between(step)) {
            const auto beside = hn::LoadU(d, weight + o.dy * kWindow + o.dx);
            least = hn::Min(least, beside);
            height = hn::Add(height, beside);
        }
        height = hn::ShiftRight<1>(height);
    }
    return hn::IfThenZeroElse(hn::Eq(least, hn::Zero(d)), height);
}

/// What an edge adds to a label: its height as it is, or times its length; far where there is no edge or
/// where it does not keep to the bottlenecks, `m` being M where the edge begins.
template <class Lane>
HWY_INLINE Vec<Lane> cost_of(Vec<Lane> height, TileRule rule, Step step, const Lane* m) {
    const Tag<Lane> d;
    const auto far = hn::Set(d, kFar<Lane>);
    const auto none = hn::Eq(height, hn::Zero(d));
    if (rule == TileRule::bottleneck) return hn::IfThenElse(none, far, height);
    const auto cost = hn::IfThenElse(none, far, hn::Mul(height, hn::Set(d, Lane(step.length5))));
    if (rule == TileRule::sum) return cost;
    const auto there = hn::LoadU(d, m + step.dy * kWindow + step.dx);
    return hn::IfThenElse(hn::Eq(hn::Max(hn::Load(d, m), height), there), cost, far);
}

/// Heights of the edges that leave a row by step s, or null where there are no planes.
inline const std::uint16_t* heights_in_plane(const WeightedLattice& g, WindowRows<std::uint16_t>& rows, int y,
                                             std::size_t s) {
    if (g.height_plane.empty()) return nullptr;
    const Step step = g.lattice.steps()[s];
    if (!g.symmetric) return rows.with_step(g.height_plane[s].data(), y, step);
    if (s % 2 == 0) return rows.with_step(g.height_plane[s / 2].data(), y, step);
    return rows.where_it_leads(g.height_plane[s / 2].data(), y, step);
}

/// Costs from node weights alone, without knight's moves: h(u, v) = w(u) + w(v), so that an edge costs as much
/// as its two ends. Ends that are impassable are far, and so are sums with them.
template <class Lane>
void load_costs_of_ends(const TileProblem& problem, int tile, TileWindow<Lane>& window) {
    const WeightedLattice& g = problem.graph;
    const auto steps = g.lattice.steps();
    const Tag<Lane> d;
    WindowRows<std::uint16_t> rows(g.lattice, problem.tiling, tile, 0);
    const std::size_t lengths = steps.size() > 4 ? 2 : 1;
    for (std::size_t k = 0; k < lengths; ++k) {
        const Lane length5 = problem.rule == TileRule::bottleneck ? Lane{1} : Lane(steps[4 * k].length5);
        Lane* const end = window.end[0][k].data();
        for (int y = 0; y < kWindow; ++y) {
            const std::uint16_t* const weight = rows(g.weight.data(), y);
            for (int x = 0; x < kWindow; x += kLanes<Lane>) {
                const auto w = lanes_from(d, weight + x);
                const auto cost = hn::Mul(w, hn::Set(d, length5));
                hn::Store(hn::IfThenElse(hn::Eq(w, hn::Zero(d)), hn::Set(d, kFar<Lane>), cost), d,
                          end + y * kWindow + x);
            }
        }
        transpose(end, window.end[1][k].data());
    }
    for (std::size_t s = 0; s < steps.size(); s += 2)
        for (const int transposed : {0, 1}) {
            if (transposed == 1 && steps[s].dx == 0) continue;  // no sweep there arrives by it
            const Lane* const from = window.end[transposed][s / 4].data();
            const Lane* const to =
                from + (transposed == 1 ? steps[s].dx * kWindow + steps[s].dy : steps[s].dy * kWindow + steps[s].dx);
            Lane* const cost = window.cost[transposed][s].data();
            for (int at = 0; at < int(kWindowNodes); at += kLanes<Lane>)
                hn::Store(sum_of(hn::Load(d, from + at), hn::LoadU(d, to + at)), d, cost + at);
        }
}

/// Fills window.cost, in both orientations. Where edges cost the same both ways, for even steps only.
template <class Lane>
void load_costs(const TileProblem& problem, int tile, bool even_only, TileWindow<Lane>& window) {
    const WeightedLattice& g = problem.graph;
    if (even_only && g.height_plane.empty() && g.lattice.steps().size() <= 8)
        return load_costs_of_ends(problem, tile, window);
    const Tag<Lane> d;
    WindowRows<std::uint16_t> rows(g.lattice, problem.tiling, tile, 0);
    if (g.height_plane.empty())
        for (int y = 0; y < kWindow; ++y) {
            const std::uint16_t* weight = rows(g.weight.data(), y);
            for (int x = 0; x < kWindow; x += kLanes<Lane>)
                hn::Store(lanes_from(d, weight + x), d, window.weight.data() + y * kWindow + x);
        }
    if (problem.rule == TileRule::sum_within_bottleneck) {
        WindowRows<std::uint32_t> labels(g.lattice, problem.tiling, tile, ~std::uint32_t{0});
        for (int y = 0; y < kWindow; ++y)
            load_row_above(labels(problem.bottleneck.data(), y), 0, window.bottleneck.data() + y * kWindow);
    }
    const auto steps = g.lattice.steps();
    for (std::size_t s = 0; s < steps.size(); s += even_only ? 2 : 1) {
        Lane* const cost = window.cost[0][s].data();
        for (int y = 0; y < kWindow; ++y) {
            const std::uint16_t* const planes_row = heights_in_plane(g, rows, y, s);
            for (int x = 0; x < kWindow; x += kLanes<Lane>) {
                const int at = y * kWindow + x;
                const auto height = planes_row != nullptr
                                        ? lanes_from(d, planes_row + x)
                                        : height_from_weights<Lane>(window.weight.data() + at, steps[s]);
                hn::Store(cost_of<Lane>(height, problem.rule, steps[s], window.bottleneck.data() + at), d, cost + at);
            }
        }
        if (steps[s].dx != 0) transpose(cost, window.cost[1][s].data());
    }
}

}  // namespace dstylize::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
