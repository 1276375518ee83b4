// The edges of a window: heights from node weights or height planes, and what they add to a label.
#if defined(DSTYLIZE_GRAPH_DETAIL_TILE_COSTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef DSTYLIZE_GRAPH_DETAIL_TILE_COSTS_INL_H_
#undef DSTYLIZE_GRAPH_DETAIL_TILE_COSTS_INL_H_
#else
#define DSTYLIZE_GRAPH_DETAIL_TILE_COSTS_INL_H_
#endif

#include <hwy/cache_control.h>

#include <algorithm>
#include <span>

#include "graph/detail_tile_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace dstylize::HWY_NAMESPACE {

/// Row y of a tile's window in a plane over the lattice: where it lies or, if it reaches out, a copy. Only of nodes
/// that are in the lattice with the ones that `step` leads to.
template <class T>
class WindowRows {
  public:
    WindowRows(const Lattice& lattice, const Tiling& tiling, int tile, T outside, Step step = {0, 0, 0})
        : width_(lattice.extent().x), origin_(tiling.origin(tile)), outside_(outside) {
        const Extent e = lattice.extent();
        top_ = std::max(0, -int(step.dy)) - origin_.dy;
        bottom_ = std::min(e.y, e.y - step.dy) - origin_.dy;
        first_ = std::max(0, std::max(0, -int(step.dx)) - origin_.dx);
        end_ = std::min(kWindow, std::min(e.x, e.x - step.dx) - origin_.dx);
    }

    const T* operator()(const T* plane, int y) {
        const std::ptrdiff_t row = std::ptrdiff_t(origin_.dy + y) * width_ + origin_.dx;
        if (first_ < end_ && y + kAhead >= top_ && y + kAhead < bottom_) ask_for(plane, row + kAhead * width_);
        const bool row_is_inside = y >= top_ && y < bottom_;
        if (row_is_inside && first_ == 0 && end_ == kWindow) return plane + row;
        std::fill_n(copy_, kWindow, outside_);
        if (row_is_inside && first_ < end_) std::copy_n(plane + (row + first_), end_ - first_, copy_ + first_);
        return copy_;
    }

  private:
    /// Rows lie pages apart, so that no processor guesses where the next one is.
    static constexpr int kAhead = 12, kLine = 64 / sizeof(T);
    void ask_for(const T* plane, std::ptrdiff_t row) const {
        for (int x = first_; x < end_; x += kLine) hwy::Prefetch(plane + (row + x));
        hwy::Prefetch(plane + (row + end_ - 1));
    }

    std::ptrdiff_t width_;
    Offset origin_;
    T outside_;
    int top_ = 0, bottom_ = 0, first_ = 0, end_ = 0;  // of the window
    alignas(64) T copy_[kWindow];
};

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

/// Highest edges, of which none is out of reach and none below the base, 0.
inline void load_row_above(const std::uint16_t* label, std::uint32_t, std::uint16_t* row) {
    std::copy_n(label, kWindow, row);
}

// A height or a cost is far where there is no edge.

template <class Lane>
HWY_INLINE Vec<Lane> far_if_zero(Vec<Lane> v) {
    const Tag<Lane> d;
    return hn::IfThenElse(hn::Eq(v, hn::Zero(d)), hn::Set(d, kFar<Lane>), v);
}

/// Heights of the edges that leave nodes by a step, from node weights that are far where nothing may pass. Two weights
/// never come to far, but four may: so half their sum is found without the sum.
template <class Lane>
HWY_INLINE Vec<Lane> height_from_weights(const Lane* weight, Step step) {
    const Tag<Lane> d;
    const auto far = hn::Set(d, kFar<Lane>);
    const auto height = hn::Min(sum_of(hn::Load(d, weight), hn::LoadU(d, weight + step.dy * kWindow + step.dx)), far);
    if (!is_knights_move(step)) return height;
    const auto [a, b] = passed_between(step);
    const auto beside = hn::Min(
        sum_of(hn::LoadU(d, weight + a.dy * kWindow + a.dx), hn::LoadU(d, weight + b.dy * kWindow + b.dx)), far);
    const auto half = hn::Add(hn::And(height, beside), hn::ShiftRight<1>(hn::Xor(height, beside)));
    return hn::IfThenElse(hn::Eq(hn::Max(height, beside), far), far, half);
}

template <class Lane>
HWY_INLINE Vec<Lane> cost_of(Vec<Lane> height, Step step) {
    const Tag<Lane> d;
    const auto far = hn::Set(d, kFar<Lane>);
    return hn::IfThenElse(hn::Eq(height, far), far, hn::Mul(height, hn::Set(d, Lane(step.length5))));
}

/// A cost where the edge u -> v keeps to the bottlenecks, max(M(u), h) = M(v); else far.
template <class Lane>
HWY_INLINE Vec<Lane> cost_within(Vec<Lane> cost, Vec<Lane> height, Vec<Lane> m_u, Vec<Lane> m_v) {
    return hn::IfThenElse(hn::Eq(hn::Max(m_u, height), m_v), cost, hn::Set(Tag<Lane>(), kFar<Lane>));
}

/// Heights of the edges that leave a row by step s, for which the rows are, or null where there are no planes.
inline const std::uint16_t* heights_in_plane(const WeightedLattice& g, WindowRows<std::uint16_t>& rows, int y,
                                             std::size_t s) {
    if (g.height_plane.empty()) return nullptr;
    return rows(g.height_plane[g.symmetric ? s / 2 : s].data(), y);
}

/// Node weights, far where nothing may pass, and bottlenecks, each if they are needed.
template <class Lane>
void load_nodes(const TileProblem& problem, int tile, TileWindow<Lane>& window) {
    const WeightedLattice& g = problem.graph;
    const Tag<Lane> d;
    if (g.height_plane.empty()) {
        WindowRows<std::uint16_t> rows(g.lattice, problem.tiling, tile, 0);
        for (int y = 0; y < kWindow; ++y) {
            const std::uint16_t* weight = rows(g.weight.data(), y);
            for (int x = 0; x < kWindow; x += kLanes<Lane>)
                hn::Store(far_if_zero<Lane>(lanes_from(d, weight + x)), d, window.weight.data() + y * kWindow + x);
        }
    }
    if (problem.rule == TileRule::sum_within_bottleneck) {
        WindowRows<std::uint16_t> rows(g.lattice, problem.tiling, tile, kFar<std::uint16_t>);
        for (int y = 0; y < kWindow; ++y) {
            const std::uint16_t* const m = rows(problem.bottleneck.data(), y);
            for (int x = 0; x < kWindow; x += kLanes<Lane>)
                hn::Store(lanes_from(d, m + x), d, window.bottleneck.data() + y * kWindow + x);
        }
    }
}

/// The costs of step s and, where an edge costs the same both ways, those of its opposite if they are wanted:
/// in bottlenecks what is free one way need not be so the other way.
template <TileRule kRule, class Lane>
void load_costs_of_step(const TileProblem& problem, int tile, std::size_t s, TileWindow<Lane>& window) {
    const WeightedLattice& g = problem.graph;
    const Tag<Lane> d;
    const Step step = g.lattice.steps()[s];
    const int ahead = step.dy * kWindow + step.dx;
    const bool both_ways = problem.symmetric();
    WindowRows<std::uint16_t> rows(g.lattice, problem.tiling, tile, 0, step);
    for (int y = 0; y < kWindow; ++y) {
        const std::uint16_t* const planes_row = heights_in_plane(g, rows, y, s);
        for (int x = 0; x < kWindow; x += kLanes<Lane>) {
            const int at = y * kWindow + x;
            const auto height = planes_row != nullptr ? far_if_zero<Lane>(lanes_from(d, planes_row + x))
                                                      : height_from_weights<Lane>(window.weight.data() + at, step);
            if constexpr (kRule == TileRule::bottleneck) {
                hn::Store(height, d, window.cost[0][s].data() + at);
                continue;
            }
            const auto cost = cost_of<Lane>(height, step);
            if constexpr (kRule == TileRule::sum) {
                hn::Store(cost, d, window.cost[0][s].data() + at);
                continue;
            }
            const Lane* const m = window.bottleneck.data() + at;
            const auto m_u = hn::Load(d, m), m_v = hn::LoadU(d, m + ahead);
            hn::Store(cost_within<Lane>(cost, height, m_u, m_v), d, window.cost[0][s].data() + at);
            if (both_ways)
                hn::StoreU(cost_within<Lane>(cost, height, m_v, m_u), d, window.cost[0][s + 1].data() + at + ahead);
        }
    }
}

/// Half costs, in both orientations: what a node adds to the cost of a straight edge (cost[..][0]) and of a diagonal
/// one (cost[..][1]), far where nothing may pass.
template <int kSteps, class Lane>
void load_half_costs(const TileProblem& problem, int tile, TileWindow<Lane>& window) {
    const WeightedLattice& g = problem.graph;
    const Step kinds[] = {g.lattice.steps()[0], g.lattice.steps()[kSteps - 1]};
    const Tag<Lane> d;
    WindowRows<std::uint16_t> rows(g.lattice, problem.tiling, tile, 0);
    for (int y = 0; y < kWindow; ++y) {
        const std::uint16_t* const weight = rows(g.weight.data(), y);
        for (int x = 0; x < kWindow; x += kLanes<Lane>) {
            const auto height = far_if_zero<Lane>(lanes_from(d, weight + x));
            for (int k = 0; k < kSteps / 4; ++k)
                hn::Store(cost_of<Lane>(height, kinds[k]), d, window.cost[0][k].data() + y * kWindow + x);
        }
    }
    for (int k = 0; k < kSteps / 4; ++k) transpose(window.cost[0][k].data(), window.cost[1][k].data());
}

/// Fills window.cost, in both orientations. Where edges cost the same both ways, for even steps only.
template <class Lane>
void load_costs(const TileProblem& problem, int tile, bool even_only, TileWindow<Lane>& window) {
    load_nodes(problem, tile, window);
    const auto steps = problem.graph.lattice.steps();
    for (std::size_t s = 0; s < steps.size(); s += problem.symmetric() ? 2 : 1) switch (problem.rule) {
            case TileRule::sum: load_costs_of_step<TileRule::sum>(problem, tile, s, window); break;
            case TileRule::bottleneck: load_costs_of_step<TileRule::bottleneck>(problem, tile, s, window); break;
            case TileRule::sum_within_bottleneck:
                load_costs_of_step<TileRule::sum_within_bottleneck>(problem, tile, s, window);
                break;
        }
    for (std::size_t s = 0; s < steps.size(); s += even_only ? 2 : 1)
        if (steps[s].dx != 0) transpose(window.cost[0][s].data(), window.cost[1][s].data());
}

}  // namespace dstylize::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
