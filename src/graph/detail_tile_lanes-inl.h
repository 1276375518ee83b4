// Vectors of 16- and 32-bit labels: shifts over a row, transposed blocks, masks. Compiled once per
// instruction set (Highway's foreach_target.h).
#if defined(DSTYLIZE_GRAPH_DETAIL_TILE_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef DSTYLIZE_GRAPH_DETAIL_TILE_LANES_INL_H_
#undef DSTYLIZE_GRAPH_DETAIL_TILE_LANES_INL_H_
#else
#define DSTYLIZE_GRAPH_DETAIL_TILE_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include <cstdint>
#include <cstring>
#include <type_traits>

#include "graph/detail_tile_window.h"

HWY_BEFORE_NAMESPACE();
namespace dstylize::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class Lane>
using Tag = hn::CappedTag<Lane, 64 / sizeof(Lane)>;
template <class Lane>
using Vec = hn::Vec<Tag<Lane>>;
template <class Lane>
inline constexpr int kLanes = int(hn::MaxLanes(Tag<Lane>()));

/// In sweeps at most 256 bits: shifts over a row are made of blocks of 128 bits and one neighbour, and what a sweep
/// takes is the time from a row to the next.
template <class Lane>
using SweepTag = hn::CappedTag<Lane, 32 / sizeof(Lane)>;
template <class Lane>
using SweepVec = hn::Vec<SweepTag<Lane>>;
template <class Lane>
inline constexpr int kSweepLanes = int(hn::MaxLanes(SweepTag<Lane>()));

/// No label, no edge. Twice that much, or that and a cost, does not wrap.
template <class Lane>
inline constexpr Lane kFar = Lane(sizeof(Lane) == 2 ? TileProblem::kNarrowFar : TileProblem::kWideFar);

template <class V>
HWY_INLINE V sum_of(V a, V b) {
    if constexpr (sizeof(hn::TFromV<V>) == 2)
        return hn::SaturatedAdd(a, b);
    else
        return hn::Add(a, b);
}

/// As many 16-bit values from p on, in lanes of either width.
HWY_INLINE Vec<std::uint16_t> lanes_from(Tag<std::uint16_t> d, const std::uint16_t* p) { return hn::LoadU(d, p); }
HWY_INLINE Vec<std::uint32_t> lanes_from(Tag<std::uint32_t> d, const std::uint16_t* p) {
    return hn::PromoteTo(d, hn::LoadU(hn::Rebind<std::uint16_t, decltype(d)>(), p));
}

/// A vector of a row with those beside it.
template <class Lane>
struct Stretch {
    SweepVec<Lane> left, here, right;

    HWY_INLINE void move_right(SweepVec<Lane> next) {
        left = here;
        here = right;
        right = next;
    }
    HWY_INLINE void move_right(const Lane* row, int x) {
        move_right(x + kSweepLanes<Lane> < kWindow ? hn::Load(SweepTag<Lane>(), row + x + kSweepLanes<Lane>)
                                                   : hn::Set(SweepTag<Lane>(), kFar<Lane>));
    }
};

#if HWY_TARGET != HWY_SCALAR
/// Lane i gets what lies kStep lanes to its left (kStep > 0) or to its right.
template <int kStep, class Lane>
HWY_INLINE SweepVec<Lane> shifted(const Stretch<Lane>& s) {
    const SweepTag<Lane> d;
    constexpr int kBytes = kStep * int(sizeof(Lane));
    constexpr bool kTwoBlocks = kSweepLanes<Lane> * sizeof(Lane) > 16;
    if constexpr (kStep == 0) {
        return s.here;
    } else if constexpr (kStep > 0) {
        if constexpr (kTwoBlocks)
            return hn::CombineShiftRightBytes<16 - kBytes>(d, s.here, hn::ConcatLowerUpper(d, s.here, s.left));
        else
            return hn::CombineShiftRightBytes<16 - kBytes>(d, s.here, s.left);
    } else {
        if constexpr (kTwoBlocks)
            return hn::CombineShiftRightBytes<-kBytes>(d, hn::ConcatLowerUpper(d, s.right, s.here), s.here);
        else
            return hn::CombineShiftRightBytes<-kBytes>(d, s.right, s.here);
    }
}

/// The block of 8 x 8 at (x, y) into its place in the transposed plane. Dealing rows out like cards,
/// the upper half between the lower, log2 of their number times, transposes them.
template <class Lane>
HWY_INLINE void transpose_block(const Lane* from, Lane* to, int x, int y) {
    constexpr int kSide = 16 / sizeof(Lane);
    const hn::FixedTag<Lane, std::size_t{kSide}> d;
    for (int j = y; j < y + 8; j += kSide)
        for (int i = x; i < x + 8; i += kSide) {
            hn::Vec<decltype(d)> r[kSide], t[kSide];
            for (int k = 0; k < kSide; ++k) r[k] = hn::Load(d, from + (j + k) * kWindow + i);
            for (int round = 1; round < kSide; round *= 2) {
                for (int k = 0; k < kSide / 2; ++k) {
                    t[2 * k] = hn::InterleaveLower(d, r[k], r[k + kSide / 2]);
                    t[2 * k + 1] = hn::InterleaveUpper(d, r[k], r[k + kSide / 2]);
                }
                for (int k = 0; k < kSide; ++k) r[k] = t[k];
            }
            for (int k = 0; k < kSide; ++k) hn::Store(r[k], d, to + (i + k) * kWindow + j);
        }
}
#else
template <class Lane>
HWY_INLINE void transpose_block(const Lane* from, Lane* to, int x, int y) {
    for (int j = y; j < y + 8; ++j)
        for (int i = x; i < x + 8; ++i) to[i * kWindow + j] = from[j * kWindow + i];
}
#endif

template <class Lane>
HWY_INLINE void transpose(const Lane* from, Lane* to) {
    for (int y = 0; y < kWindow; y += 8)
        for (int x = 0; x < kWindow; x += 8) transpose_block(from, to, x, y);
}

/// A bit for each lane. (As many bytes are read as are stored: a processor waits before it reads more than it has just
/// written.)
template <class D>
HWY_INLINE std::uint64_t bits_of(D d, hn::Mask<D> mask) {
    constexpr std::size_t kLanesOfD = hn::MaxLanes(D());
    using Wide = std::conditional_t<(kLanesOfD > 16), std::uint32_t, std::uint16_t>;
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, mask, bytes);
    if constexpr (kLanesOfD <= 8) return bytes[0];
    Wide bits;
    std::memcpy(&bits, bytes, sizeof bits);
    return bits;
}
#if HWY_TARGET != HWY_AVX3
/// Bits of 16-bit lanes are gathered from bytes: without them AVX2 needs pext, which takes a hundred cycles on some
/// processors.
HWY_INLINE std::uint64_t bits_of(Tag<std::uint16_t> d, hn::Mask<Tag<std::uint16_t>> mask) {
    const hn::RebindToSigned<decltype(d)> whole;
    const hn::Rebind<std::int8_t, decltype(d)> bytes;
    return bits_of(bytes, hn::MaskFromVec(hn::DemoteTo(bytes, hn::BitCast(whole, hn::VecFromMask(d, mask)))));
}
#endif

/// Which of the 64 lanes are above a bound.
template <class Lane>
HWY_INLINE std::uint64_t lanes_above(const Lane* lanes, Lane bound) {
    const Tag<Lane> d;
    std::uint64_t bits = 0;
    for (int x = 0; x < kWindow; x += kLanes<Lane>)
        bits |= bits_of(d, hn::Lt(hn::Set(d, bound), hn::Load(d, lanes + x))) << x;
    return bits;
}

/// Which of the 64 lanes of a are below those of b.
template <class Lane>
HWY_INLINE std::uint64_t lanes_below(const Lane* a, const Lane* b) {
    const Tag<Lane> d;
    std::uint64_t bits = 0;
    for (int x = 0; x < kWindow; x += kLanes<Lane>)
        bits |= bits_of(d, hn::Lt(hn::Load(d, a + x), hn::Load(d, b + x))) << x;
    return bits;
}

}  // namespace dstylize::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
