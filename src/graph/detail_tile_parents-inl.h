// Parents from labels at rest: among the neighbours that give a node its label the one with the smallest
// label, then index. Neighbours are tried by index, and a later one has to be strictly better.
#if defined(DSTYLIZE_GRAPH_DETAIL_TILE_PARENTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef DSTYLIZE_GRAPH_DETAIL_TILE_PARENTS_INL_H_
#undef DSTYLIZE_GRAPH_DETAIL_TILE_PARENTS_INL_H_
#else
#define DSTYLIZE_GRAPH_DETAIL_TILE_PARENTS_INL_H_
#endif

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "graph/detail_tile_lanes-inl.h"
#include "graph/detail_tiles.h"
#include "graph/plan.h"

HWY_BEFORE_NAMESPACE();
namespace dstylize::HWY_NAMESPACE {

/// A row of nodes and the labels that their parents are to explain.
struct ParentRow {
    const WeightedLattice& graph;
    const std::uint32_t* sum;         // of all nodes
    const std::uint16_t* bottleneck;  // the same; none for `sum`
    int row;
};

/// Steps ordered by the node that they come from, first by row, then by column.
struct StepOrder {
    explicit StepOrder(std::span<const Step> steps) : count(steps.size()) {
        for (std::size_t s = 0; s < count; ++s) step[s] = std::uint8_t(s);
        std::sort(step.begin(), step.begin() + std::ptrdiff_t(count), [&](std::uint8_t a, std::uint8_t b) {
            return steps[a].dy != steps[b].dy ? steps[a].dy > steps[b].dy : steps[a].dx > steps[b].dx;
        });
    }
    std::size_t count;
    std::array<std::uint8_t, 16> step{};
};

/// Any node, by the definition.
inline std::uint8_t parent_of(const ParentRow& r, const StepOrder& order, int column) {
    const WeightedLattice& g = r.graph;
    const std::uint32_t v = index(g.lattice.at(column, r.row));
    std::uint32_t best_m = ~std::uint32_t{0}, best_s = r.sum[v];
    std::uint8_t best = ParentColumn::kNoStep;
    for (std::size_t k = 0; k < order.count; ++k) {
        const int s = order.step[k];
        const NodeId from = g.neighbour(NodeId{v}, s ^ 1);
        if (from == kNoNode) continue;
        const std::uint32_t u = index(from), height = g.height(from, s);
        if (height == 0 || r.sum[u] >= r.sum[v]) continue;
        if (r.sum[u] + height * g.lattice.steps()[std::size_t(s)].length5 != r.sum[v]) continue;
        if (r.bottleneck == nullptr) {
            if (r.sum[u] >= best_s) continue;
        } else {
            if (std::max(std::uint32_t{r.bottleneck[u]}, height) != r.bottleneck[v]) continue;
            if (best != ParentColumn::kNoStep &&
                (r.bottleneck[u] > best_m || (r.bottleneck[u] == best_m && r.sum[u] >= best_s)))
                continue;
            best_m = r.bottleneck[u];
        }
        best_s = r.sum[u];
        best = std::uint8_t(s);
    }
    return best;
}

/// How far a step can lead.
inline constexpr int kReach = 2;

/// How a step arrives at the nodes of a row; nodes are counted from the one it arrives at.
struct Arrival {
    Arrival(const WeightedLattice& g, std::uint8_t s) : step(s), length5(g.lattice.steps()[s].length5) {
        const Step by = g.lattice.steps()[s];
        const std::ptrdiff_t width = g.lattice.extent().x;
        from = -(by.dy * width + by.dx);
        if (!g.height_plane.empty()) {
            const bool at_target = g.symmetric && s % 2 == 1;
            height = g.height_plane[g.symmetric ? s / 2u : s].data();
            height_from = at_target ? 0 : from;
        } else if (is_knights_move(by)) {
            touches_four = true;
            for (std::size_t k = 0; k < 2; ++k) {
                const Offset o = passed_between(by)[k];
                beside[k] = from + o.dy * width + o.dx;
            }
        }
    }
    std::uint8_t step;
    std::uint32_t length5;
    std::ptrdiff_t from = 0, height_from = 0;
    const std::uint16_t* height = nullptr;  // in a plane
    bool touches_four = false;
    std::ptrdiff_t beside[2] = {};
};

/// Heights of the edges that arrive so at the nodes from v on, of the weights own; 0 where there is none.
template <bool kPlanes, class Lane>
HWY_INLINE Vec<Lane> heights_to(const std::uint16_t* weight, std::ptrdiff_t v, Vec<Lane> own, const Arrival& by) {
    const Tag<Lane> d;
    if constexpr (kPlanes) return lanes_from(d, by.height + (v + by.height_from));
    const auto other = lanes_from(d, weight + (v + by.from));
    auto least = hn::Min(own, other), height = hn::Add(own, other);
    if (by.touches_four) {
        for (const std::ptrdiff_t o : by.beside) {
            const auto beside = lanes_from(d, weight + (v + o));
            least = hn::Min(least, beside);
            height = hn::Add(height, beside);
        }
        height = hn::ShiftRight<1>(height);
    }
    return hn::IfThenZeroElse(hn::Eq(least, hn::Zero(d)), height);
}

/// As many nodes as a vector has lanes, none of whose steps leave the row's ends.
template <bool kBottleneck, bool kPlanes>
HWY_INLINE void parents_of_stretch(const ParentRow& r, std::span<const Arrival> arrivals, std::ptrdiff_t v,
                                   std::uint8_t* out) {
    const Tag<std::uint32_t> d;
    const std::uint16_t* const weight = r.graph.weight.data();
    const auto sum_v = hn::LoadU(d, r.sum + v);
    auto own = hn::Zero(d), m_v = hn::Zero(d), best_m = hn::Set(d, ~0u);
    auto best_s = sum_v, best = hn::Set(d, ParentColumn::kNoStep);
    if constexpr (!kPlanes) own = lanes_from(d, weight + v);
    if constexpr (kBottleneck) m_v = lanes_from(d, r.bottleneck + v);
    for (const Arrival& by : arrivals) {
        const auto height = heights_to<kPlanes, std::uint32_t>(weight, v, own, by);
        const auto sum_u = hn::LoadU(d, r.sum + (v + by.from));
        const auto reached = hn::Add(sum_u, hn::Mul(height, hn::Set(d, by.length5)));
        // Costs are not 0, so a parent's sum is smaller; then nothing wrapped, and the edge exists.
        auto better = hn::Eq(reached, sum_v);
        if constexpr (kBottleneck) {
            const auto m_u = lanes_from(d, r.bottleneck + (v + by.from));
            better = hn::And(hn::And(better, hn::Lt(sum_u, sum_v)), hn::Eq(hn::Max(m_u, height), m_v));
            better = hn::And(better, hn::Or(hn::Lt(m_u, best_m), hn::And(hn::Eq(m_u, best_m), hn::Lt(sum_u, best_s))));
            best_m = hn::IfThenElse(better, m_u, best_m);
        } else {
            better = hn::And(better, hn::Lt(sum_u, best_s));
        }
        best_s = hn::IfThenElse(better, sum_u, best_s);
        best = hn::IfThenElse(better, hn::Set(d, std::uint32_t(by.step)), best);
    }
    const hn::Rebind<std::uint8_t, decltype(d)> bytes;
    hn::StoreU(hn::DemoteTo(bytes, hn::BitCast(hn::RebindToSigned<decltype(d)>(), best)), bytes, out);
}

/// The arrivals of a row that begin inside the lattice, by the index of the node that they come from.
inline std::vector<Arrival> arrivals_of_row(const WeightedLattice& g, const StepOrder& order, int row) {
    std::vector<Arrival> arrivals;
    for (std::size_t k = 0; k < order.count; ++k) {
        const int from_row = row - g.lattice.steps()[order.step[k]].dy;
        if (from_row >= 0 && from_row < g.lattice.extent().y) arrivals.emplace_back(g, order.step[k]);
    }
    return arrivals;
}

/// Calls stretch(column) so that stretches of so many nodes cover a row but for its ends, and single(column) there. The
/// last two stretches overlap.
template <class Single, class Stretched>
HWY_INLINE void cover_row(int width, int at_once, Single single, Stretched stretch) {
    const int end = width - kReach;
    int column = std::min(kReach, width);
    for (int c = 0; c < column; ++c) single(c);
    if (end - column >= at_once) {
        for (; column + at_once <= end; column += at_once) stretch(column);
        if (column < end) stretch(end - at_once);
        column = end;
    }
    for (; column < width; ++column) single(column);
}

/// The same where single nodes are done by the definition.
template <class Stretched>
HWY_INLINE void cover_row(const ParentRow& r, const StepOrder& order, int at_once, std::uint8_t* out,
                          Stretched stretch) {
    cover_row(
        r.graph.lattice.extent().x, at_once, [&](int c) { out[c] = parent_of(r, order, c); }, stretch);
}

template <bool kBottleneck, bool kPlanes>
void parents_of_row(const ParentRow& r, const StepOrder& order, std::uint8_t* out) {
    const std::vector<Arrival> arrivals = arrivals_of_row(r.graph, order, r.row);
    cover_row(r, order, kLanes<std::uint32_t>, out, [&](int column) {
        parents_of_stretch<kBottleneck, kPlanes>(r, arrivals, index(r.graph.lattice.at(column, r.row)), out + column);
    });
}

}  // namespace dstylize::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
