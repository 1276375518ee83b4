// Many numbers at once, compiled for each instruction set; vectors of unknown length fit into no struct.
#define HWY_DISABLED_TARGETS (HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/noise.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/noise.h"

HWY_BEFORE_NAMESPACE();
namespace dstylize::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The two halves of 64-bit products.
struct Product {
    hn::Vec<hn::ScalableTag<std::uint32_t>> high, low;
};

HWY_INLINE Product product(hn::Vec<hn::ScalableTag<std::uint32_t>> v, std::uint32_t factor) {
    const hn::ScalableTag<std::uint32_t> d;
    const auto by = hn::Set(d, factor);
#if HWY_TARGET == HWY_SCALAR
    const std::uint64_t whole = std::uint64_t{hn::GetLane(v)} * factor;
    return {hn::Set(d, std::uint32_t(whole >> 32)), hn::Mul(v, by)};
#else
    const hn::RepartitionToWide<decltype(d)> d64;
    const auto of_even = hn::MulEven(v, by),
               of_odd = hn::MulEven(hn::BitCast(d, hn::ShiftRight<32>(hn::BitCast(d64, v))), by);
    return {hn::OddEven(hn::BitCast(d, of_odd), hn::BitCast(d, hn::ShiftRight<32>(of_even))), hn::Mul(v, by)};
#endif
}

/// Noise::units() for whole vectors; returns how many.
std::size_t whole_vectors(const Noise::Stream& stream, std::uint64_t first, std::size_t count, float* out) {
    const hn::ScalableTag<std::uint32_t> d;
    const hn::RebindToFloat<decltype(d)> df;
    const hn::RebindToSigned<decltype(d)> di;
    const std::size_t lanes = hn::Lanes(d);
    std::size_t n = 0;
    for (; n + lanes <= count; n += lanes) {
        const std::uint64_t index = first + n;
        // Where the lower half of the counter wraps, the upper one is 1 more.
        auto a = hn::Add(hn::Set(d, std::uint32_t(index)), hn::Iota(d, 0));
        auto b = hn::Set(d, std::uint32_t(index >> 32));
        b = hn::Sub(b, hn::VecFromMask(d, hn::Lt(a, hn::Set(d, std::uint32_t(index)))));
        auto c = hn::Set(d, stream.purpose), e = hn::Set(d, stream.substream);
        auto key = stream.key;
        for (int round = 0; round < Noise::kRounds; ++round, key = Noise::next_key(key)) {
            const Product p = product(a, Noise::kFactors[0]), q = product(c, Noise::kFactors[1]);
            a = hn::Xor(hn::Xor(q.high, b), hn::Set(d, key[0]));
            b = q.low;
            c = hn::Xor(hn::Xor(p.high, e), hn::Set(d, key[1]));
            e = p.low;
        }
        const auto whole = hn::ConvertTo(df, hn::BitCast(di, hn::ShiftRight<8>(a)));
        hn::StoreU(hn::Mul(whole, hn::Set(df, Noise::kUnit)), df, out + n);
    }
    return n;
}

}  // namespace dstylize::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dstylize {

HWY_EXPORT(whole_vectors);

void Noise::units(std::uint64_t first, std::span<float> out) const {
    std::size_t n = HWY_DYNAMIC_DISPATCH(whole_vectors)(stream_, first, out.size(), out.data());
    for (; n < out.size(); ++n) out[n] = unit(first + n);
}

}  // namespace dstylize
#endif
