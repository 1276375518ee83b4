#include "core/noise.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <set>
#include <vector>

namespace dstylize {
namespace {

using Words = std::array<std::uint32_t, 4>;

// Random123 (kat_vectors): philox4x32-10. Counter words are (index low, index high, purpose, substream).
TEST(Noise, IsPhilox4x32With10Rounds) {
    EXPECT_EQ(Noise(0, Purpose(0), 0).block(0), (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
    EXPECT_EQ(Noise(~0ull, Purpose(0xffffffff), 0xffffffff).block(~0ull),
              (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
    EXPECT_EQ(Noise(0x299f31d0a4093822, Purpose(0x13198a2e), 0x03707344).block(0x85a308d3243f6a88),
              (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Noise, BitsAreTheFirstWord) {
    const Noise noise(42, Purpose::swirl, 3);
    for (std::uint64_t i = 0; i < 100; ++i) EXPECT_EQ(noise.bits(i), noise.block(i)[0]);
}

TEST(Noise, UnitsAreUnitOfEachIndexOnEveryInstructionSet) {
    const Noise noise(7, Purpose::white_noise, 2);
    for (std::int64_t rest = hwy::SupportedTargets(); rest != 0; rest &= rest - 1) {
        hwy::SetSupportedTargetsForTest(rest & -rest);
        SCOPED_TRACE(hwy::TargetName(rest & -rest));
        for (const std::uint64_t first : {std::uint64_t{0}, (std::uint64_t{1} << 32) - 50, ~std::uint64_t{0} - 1000})
            for (const std::size_t count : {0u, 1u, 31u, 32u, 33u, 200u}) {
                std::vector<float> units(count);
                noise.units(first, units);
                for (std::size_t k = 0; k < count; ++k)
                    EXPECT_EQ(units[k], noise.unit(first + k)) << first << " + " << k;
            }
    }
    hwy::SetSupportedTargetsForTest(0);
}

TEST(Noise, UnitIsUniformBelowOne) {
    const Noise noise(1, Purpose::white_noise);
    double sum = 0;
    std::array<int, 10> histogram{};
    for (std::uint64_t i = 0; i < 100000; ++i) {
        const float u = noise.unit(i);
        ASSERT_GE(u, 0.f);
        ASSERT_LT(u, 1.f);
        sum += u;
        ++histogram[std::size_t(u * 10)];
    }
    EXPECT_NEAR(sum / 100000, 0.5, 0.005);
    for (const int count : histogram) EXPECT_NEAR(count, 10000, 500);
}

TEST(Noise, DiffersBySeedPurposeSubstreamAndIndex) {
    std::set<std::uint32_t> seen;
    for (const std::uint64_t seed : {1ull, 2ull, 1ull << 32})
        for (const Purpose purpose : {Purpose::white_noise, Purpose::jitter})
            for (const std::uint32_t sub : {0u, 1u})
                for (const std::uint64_t i : {0ull, 1ull, 1ull << 32}) seen.insert(Noise(seed, purpose, sub).bits(i));
    EXPECT_EQ(seen.size(), 3u * 2 * 2 * 3);
}

}  // namespace
}  // namespace dstylize
