// The walk along a forest by vectors of nodes. Next to nothing is computed for a node, but where it lies in memory no
// processor guesses: so several vectors are on their way in turns, and the memory of each is asked for a turn ahead.
#if defined(DSTYLIZE_GRAPH_DETAIL_TILE_WALK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef DSTYLIZE_GRAPH_DETAIL_TILE_WALK_INL_H_
#undef DSTYLIZE_GRAPH_DETAIL_TILE_WALK_INL_H_
#else
#define DSTYLIZE_GRAPH_DETAIL_TILE_WALK_INL_H_
#endif

#include <hwy/cache_control.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "graph/detail_forest_walk.h"
#include "graph/detail_tile_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace dstylize::HWY_NAMESPACE {

using WalkTag = Tag<std::uint32_t>;
using WalkVec = Vec<std::uint32_t>;
inline constexpr std::size_t kWalkLanes = std::size_t(kLanes<std::uint32_t>);

HWY_INLINE WalkVec gather(const std::uint32_t* from, WalkVec index) {
    const WalkTag d;
    return hn::GatherIndex(d, from, hn::BitCast(hn::RebindToSigned<WalkTag>(), index));
}

/// The values of some steps.
HWY_INLINE WalkVec of_step(const std::array<std::uint32_t, 16>& values, WalkVec step) {
    const WalkTag d;
    if constexpr (kWalkLanes >= kMostWalkedSteps)
        return hn::TableLookupLanes(hn::LoadU(d, values.data()), hn::IndicesFromVec(d, step));
    else
        return gather(values.data(), step);
}

/// Nodes that have their sums, and the steps by which the walk goes on, a bit each.
struct ReachedNodes {
    WalkVec node_place, sum, weight, children;
};

/// The number of the lowest bit that is set; anything below kMostWalkedSteps where there is none.
HWY_INLINE WalkVec lowest_bit(WalkVec bits) {
    const WalkTag d;
    const auto lowest = hn::AndNot(hn::Sub(bits, hn::Set(d, 1u)), bits);
    const auto exponent =
        hn::BitCast(d, hn::ConvertTo(hn::RebindToFloat<WalkTag>(), hn::BitCast(hn::RebindToSigned<WalkTag>(), lowest)));
    return hn::And(hn::Add(hn::ShiftRight<23>(exponent), hn::Set(d, 1u)), hn::Set(d, kMostWalkedSteps - 1u));
}

/// Heights of the edges to some nodes, in planes.
HWY_INLINE WalkVec heights_in_planes(const WalkGround& ground, const std::uint32_t* place) {
    std::uint32_t height[kWalkLanes];
    for (std::size_t k = 0; k < kWalkLanes; ++k) height[k] = ground.height_to(place[k]);
    return hn::LoadU(WalkTag(), height);
}

template <bool kPlanes>
HWY_INLINE ReachedNodes reach(const WalkGround& ground, const std::uint32_t* place, const std::uint32_t* known,
                              WalkedNode* node) {
    const WalkTag d;
    const auto at = hn::LoadU(d, place), step = hn::And(at, hn::Set(d, kMostWalkedSteps - 1u));
    const auto index = hn::ShiftRight<3>(at), word = gather(node, index);
    ReachedNodes r;
    r.node_place = hn::ShiftLeft<3>(index);
    r.weight = hn::And(word, hn::Set(d, 0xffffu));
    const auto height = kPlanes ? heights_in_planes(ground, place) : r.weight;
    r.sum = hn::Add(hn::LoadU(d, known), hn::Mul(height, of_step(ground.length5, step)));
    if (kPlanes) r.weight = hn::Zero(d);
    hn::ScatterIndex(r.sum, d, node, hn::BitCast(hn::RebindToSigned<WalkTag>(), index));
    const auto back = hn::Shl(hn::Set(d, 1u), hn::Xor(step, hn::Set(d, 1u)));
    r.children = hn::AndNot(back, hn::And(hn::ShiftRight<16>(word), hn::Set(d, 0xffu)));
    return r;
}

/// Writes children, all of them, and beyond them as many as a vector has lanes. Returns how many they are.
HWY_INLINE std::size_t put_children(const WalkGround& ground, ReachedNodes r, std::uint32_t* place,
                                    std::uint32_t* known) {
    const WalkTag d;
    std::size_t count = 0;
    for (;;) {
        const auto has_more = hn::Ne(r.children, hn::Zero(d));
        const std::size_t more = hn::CountTrue(d, has_more);
        if (more == 0) return count;
        const auto step = lowest_bit(r.children);
        const auto to = hn::Add(r.node_place, of_step(ground.ahead, step));
        const auto sum = hn::Add(r.sum, hn::Mul(r.weight, of_step(ground.length5, step)));
        hn::StoreU(hn::Compress(to, has_more), d, place + count);
        hn::StoreU(hn::Compress(sum, has_more), d, known + count);
        count += more;
        r.children = hn::And(r.children, hn::Sub(r.children, hn::Set(d, 1u)));
    }
}

template <bool kPlanes>
bool follow(const WalkGround& ground, WalkedNode* node, Frontier& frontier) {
    constexpr std::size_t kTurns = 32;
    const WalkTag d;
    std::uint32_t place[kWays], known[kWays];
    std::size_t top = frontier.size(), ways = kWays;
    frontier.resize(top + kTurns * kWays * kMostWalkedSteps);
    const auto take = [&](std::size_t way) {
        top -= kWalkLanes;
        hn::StoreU(hn::LoadU(d, frontier.place.data() + top), d, place + way);
        hn::StoreU(hn::LoadU(d, frontier.sum.data() + top), d, known + way);
        for (std::size_t k = way; k < way + kWalkLanes; ++k) hwy::Prefetch(node + (place[k] >> 3));
    };
    for (std::size_t way = 0; way < kWays; way += kWalkLanes) take(way);
    auto largest = hn::Zero(d);
    for (std::size_t turn = 0; turn < kTurns; ++turn)
        for (std::size_t way = 0; way < ways; way += kWalkLanes) {
            const ReachedNodes reached = reach<kPlanes>(ground, place + way, known + way, node);
            largest = hn::Max(largest, reached.sum);
            top += put_children(ground, reached, frontier.place.data() + top, frontier.sum.data() + top);
            if (top >= kWalkLanes) {
                take(way);
                continue;
            }
            ways -= kWalkLanes;
            std::copy_n(place + ways, kWalkLanes, place + way);
            std::copy_n(known + ways, kWalkLanes, known + way);
            way -= kWalkLanes;
        }
    std::copy_n(place, ways, frontier.place.data() + top);
    std::copy_n(known, ways, frontier.sum.data() + top);
    frontier.resize(top + ways);
    return hn::AllTrue(d, hn::Lt(largest, hn::Set(d, std::uint32_t{kUnreachedWord})));
}

inline bool walk_on(const WalkGround& ground, WalkedNode* node, Frontier& frontier) {
    return ground.graph.height_plane.empty() ? follow<false>(ground, node, frontier)
                                             : follow<true>(ground, node, frontier);
}

}  // namespace dstylize::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
