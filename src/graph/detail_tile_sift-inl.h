// The passes of sift_tile: each node's least edge, the trees that these make, and which edges are left.
#if defined(DSTYLIZE_GRAPH_DETAIL_TILE_SIFT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef DSTYLIZE_GRAPH_DETAIL_TILE_SIFT_INL_H_
#undef DSTYLIZE_GRAPH_DETAIL_TILE_SIFT_INL_H_
#else
#define DSTYLIZE_GRAPH_DETAIL_TILE_SIFT_INL_H_
#endif

#include <array>
#include <bit>
#include <utility>

#include "graph/detail_tile_costs-inl.h"
#include "graph/detail_tile_forest.h"

HWY_BEFORE_NAMESPACE();
namespace dstylize::HWY_NAMESPACE {

/// Heights of the edges of a window, each with its smaller node.
inline void load_heights(const WeightedLattice& g, const Tiling& tiling, int tile, SiftedTile& t) {
    using Lane = std::uint16_t;
    const Tag<Lane> d;
    if (g.height_plane.empty()) {
        WindowRows<Lane> rows(g.lattice, tiling, tile, 0);
        for (int y = 0; y < kWindow; ++y) {
            const Lane* const weight = rows(g.weight.data(), y);
            for (int x = 0; x < kWindow; x += kLanes<Lane>)
                hn::Store(far_if_zero<Lane>(hn::LoadU(d, weight + x)), d, t.weight.data() + y * kWindow + x);
        }
    }
    const auto steps = g.lattice.steps();
    for (std::size_t k = 0; k < kForward.size(); ++k) {
        Lane* const out = t.height[k].data();
        if (kForwardStep[k] >= steps.size()) {
            std::fill_n(out, kWindowNodes, kFar<Lane>);
            continue;
        }
        // Planes hold the height of an even step with the node that it leaves, which may be the larger one.
        const std::size_t even = kForwardStep[k] & ~1u;
        WindowRows<Lane> rows(g.lattice, tiling, tile, 0, steps[even]);
        const int to_smaller = even == kForwardStep[k] ? 0 : -in_window(kForward[k]);
        for (int y = 0; y < kWindow; ++y) {
            const Lane* const plane_row = heights_in_plane(g, rows, y, even);
            for (int x = 0; x < kWindow; x += kLanes<Lane>) {
                const int at = y * kWindow + x;
                const auto height = plane_row != nullptr ? far_if_zero<Lane>(hn::LoadU(d, plane_row + x))
                                                         : height_from_weights<Lane>(t.weight.data() + at, steps[even]);
                hn::StoreU(height, d, out + at + to_smaller);
            }
        }
    }
}

/// The steps from a node in the order of its edges: to smaller nodes, then to larger ones. Half of them are opposites.
inline constexpr std::array<Offset, 8> kAround{{{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};
inline constexpr std::array<std::uint8_t, 8> kAroundStep{5, 3, 6, 1, 0, 7, 2, 4};

/// Each node's least edge: its step's bit, and the node that it leads to.
inline void choose_edges(SiftedTile& t) {
    const Tag<std::uint16_t> d;
    const hn::Rebind<std::uint8_t, decltype(d)> bytes;
    for (int at = kWindow; at < kWindow * (kWindow - 1); at += kLanes<std::uint16_t>) {
        auto least = hn::Set(d, kFar<std::uint16_t>), bit = hn::Zero(d), ahead = hn::Zero(d);
        for (std::size_t r = 0; r < kAround.size(); ++r) {
            const int offset = in_window(kAround[r]);
            const std::uint16_t* const height = r < 4 ? t.height[3 - r].data() + offset : t.height[r - 4].data();
            const auto h = hn::LoadU(d, height + at);
            const auto lower = hn::Lt(h, least);
            least = hn::Min(least, h);
            bit = hn::IfThenElse(lower, hn::Set(d, std::uint16_t(1u << kAroundStep[r])), bit);
            ahead = hn::IfThenElse(lower, hn::Set(d, std::uint16_t(offset)), ahead);
        }
        hn::Store(hn::Add(hn::Iota(d, std::uint16_t(at)), ahead), d, t.root.data() + at);
        hn::StoreU(hn::DemoteTo(bytes, hn::BitCast(hn::RebindToSigned<decltype(d)>(), bit)), bytes,
                   t.chosen.data() + at);
    }
}

/// Takes back what may not be chosen in a tile: edges of the rim, edges to it, and those of sources.
inline void keep_choices_inside(std::span<const std::uint64_t, kWindow> sources, SiftedTile& t) {
    const auto stay = [&](int node) {
        t.root.data()[node] = std::uint16_t(node);
        t.chosen.data()[node] = 0;
    };
    constexpr int kEnd = kWindow - 1;
    for (int i = 0; i < kWindow; ++i)
        for (const int node : {i, kEnd * kWindow + i, i * kWindow, i * kWindow + kEnd}) stay(node);
    for (int i = 1; i < kEnd; ++i)
        for (const int node : {kWindow + i, (kEnd - 1) * kWindow + i, i * kWindow + 1, i * kWindow + kEnd - 1})
            if (is_rim(t.root.data()[node])) stay(node);
    for (int y = 0; y < kWindow; ++y)
        for (std::uint64_t rest = sources[std::size_t(y)]; rest != 0; rest &= rest - 1)
            stay(y * kWindow + std::countr_zero(rest));
}

/// From chosen edges to the steps of their both ends.
inline void mark_chosen(SiftedTile& t) {
    const Tag<std::uint8_t> d;
    for (int at = kWindow; at < kWindow * (kWindow - 1); at += kLanes<std::uint8_t>) {
        auto steps = hn::Load(d, t.chosen.data() + at);
        for (std::size_t r = 0; r < kAround.size(); ++r) {
            const auto there = hn::LoadU(d, t.chosen.data() + at + in_window(kAround[r]));
            const auto chose_me = hn::TestBit(there, hn::Set(d, std::uint8_t(1u << (kAroundStep[r] ^ 1u))));
            steps = hn::Or(steps, hn::IfThenElseZero(chose_me, hn::Set(d, std::uint8_t(1u << kAroundStep[r]))));
        }
        hn::Store(steps, d, t.steps.data() + at);
    }
}

/// Leads nodes on towards the roots of their trees, by turns downwards and upwards: either way what lies behind is far
/// on its way already, and few have not arrived in the end. Of two nodes that chose each other the first to be led on,
/// the smaller one, comes to itself and is the root.
inline void find_roots(SiftedTile& t) {
    constexpr int kFirst = kWindow, kEnd = kWindow * (kWindow - 1);
    std::uint16_t* const root = t.root.data();
    const auto lead_on = [&](int n) { root[n] = root[root[n]]; };
    for (int n = kFirst; n < kEnd; ++n) lead_on(n);
    for (int n = kEnd - 1; n >= kFirst; --n) lead_on(n);
    for (int n = kFirst; n < kEnd; ++n) lead_on(n);
}

/// A node and a place in kForward, counted from a node nearby.
struct NearbyEdge {
    Offset from;
    std::size_t forward;
};
constexpr NearbyEdge edge_between(Offset a, Offset b) {
    const bool in_order = a.dy != b.dy ? a.dy < b.dy : a.dx < b.dx;
    const Offset from = in_order ? a : b, to = in_order ? b : a;
    std::size_t k = 0;
    while (kForward[k].dx != to.dx - from.dx || kForward[k].dy != to.dy - from.dy) ++k;
    return {from, k};
}
constexpr bool are_neighbours(Offset a, Offset b) {
    const int dx = a.dx - b.dx, dy = a.dy - b.dy;
    return (dx != 0 || dy != 0) && dx * dx <= 1 && dy * dy <= 1;
}
/// Whether an edge of the same height comes before the one that leaves (0, 0) by kForward[k].
constexpr bool precedes(NearbyEdge e, std::size_t k) {
    return e.from.dy != 0 ? e.from.dy < 0 : e.from.dx != 0 ? e.from.dx < 0 : e.forward < k;
}

/// Which edges by kForward[kPlace] are the greatest of the triangle with the node at kCorner, if it is one.
template <std::size_t kPlace, int kCorner>
HWY_INLINE void drop_greatest(const SiftedTile& t, int at, Vec<std::uint16_t> height,
                              hn::Mask<Tag<std::uint16_t>>& dropped) {
    constexpr Offset kAt{kCorner % 5 - 2, kCorner / 5 - 2};
    if constexpr (are_neighbours(kAt, {0, 0}) && are_neighbours(kAt, kForward[kPlace])) {
        const Tag<std::uint16_t> d;
        const auto before = [&]<std::size_t kFrom>(std::integral_constant<std::size_t, kFrom>) {
            constexpr NearbyEdge kEdge = edge_between(kAt, kFrom == 0 ? Offset{0, 0} : kForward[kPlace]);
            const auto other = hn::LoadU(d, t.height[kEdge.forward].data() + at + in_window(kEdge.from));
            if constexpr (precedes(kEdge, kPlace))
                return hn::Eq(hn::Min(other, height), other);
            else
                return hn::Lt(other, height);
        };
        const auto both =
            hn::And(before(std::integral_constant<std::size_t, 0>()), before(std::integral_constant<std::size_t, 1>()));
        dropped = hn::Or(dropped, both);
    }
}

/// Columns of a row from which kForward[k] leads from or to one of the tile's own nodes.
constexpr std::uint64_t own_columns(int y, std::size_t k) {
    std::uint64_t columns = 0;
    for (int x = 0; x < kWindow; ++x) {
        const int x_to = x + kForward[k].dx, y_to = y + kForward[k].dy;
        if (x_to < 0 || x_to >= kWindow || y_to >= kWindow) continue;
        if (is_rim(y * kWindow + x) && is_rim(y_to * kWindow + x_to)) continue;
        columns |= std::uint64_t{1} << x;
    }
    return columns;
}

template <std::size_t kPlace>
void list_edges(SiftedTile& t) {
    const Tag<std::uint16_t> d;
    constexpr int kAhead = in_window(kForward[kPlace]);
    constexpr std::uint64_t kColumns[3] = {own_columns(0, kPlace), own_columns(1, kPlace),
                                           own_columns(kWindow - 2, kPlace)};
    std::uint32_t* out = t.edge + t.edge_count;
    for (int y = 0; y < kWindow - 1; ++y) {
        std::uint64_t kept = 0;
        for (int x = 0; x < kWindow; x += kLanes<std::uint16_t>) {
            const int at = y * kWindow + x;
            const auto height = hn::Load(d, t.height[kPlace].data() + at);
            auto dropped = hn::Or(hn::Eq(height, hn::Set(d, kFar<std::uint16_t>)),
                                  hn::Eq(hn::Load(d, t.root.data() + at), hn::LoadU(d, t.root.data() + at + kAhead)));
            [&]<int... kCorners>(std::integer_sequence<int, kCorners...>) {
                (drop_greatest<kPlace, kCorners>(t, at, height, dropped), ...);
            }
            (std::make_integer_sequence<int, 25>());
            kept |= bits_of(d, hn::Not(dropped)) << x;
        }
        kept &= kColumns[y == 0 ? 0 : y == kWindow - 2 ? 2 : 1];
        for (; kept != 0; kept &= kept - 1) {
            const int node = y * kWindow + std::countr_zero(kept);
            *out++ = TileEdge(t.height[kPlace].data()[node], node, int(kPlace)).key;
        }
    }
    t.edge_count = std::size_t(out - t.edge);
}

inline void sift_tile(const WeightedLattice& graph, const Tiling& tiling, int tile,
                      std::span<const std::uint64_t, kWindow> sources, SiftedTile& t) {
    load_heights(graph, tiling, tile, t);
    choose_edges(t);
    keep_choices_inside(sources, t);
    mark_chosen(t);
    find_roots(t);
    t.edge_count = 0;
    list_edges<0>(t);
    list_edges<1>(t);
    list_edges<2>(t);
    list_edges<3>(t);
}

}  // namespace dstylize::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
