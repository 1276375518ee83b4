#include "imaging/filters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "support/scenes.h"

namespace dstylize {
namespace {

TEST(Filters, ABlurIsSymmetricWhereverThePointLies) {
    constexpr int kHeight = 300, kReach = 12;
    for (const int row : {40, 63, 64, 127, 128, 200}) {
        Grid<float> field({31, kHeight});
        field(15, row) = 1;
        const Grid<float> out = blurred(field, 3);
        EXPECT_GT(out(15, row), 0);
        for (int d = 1; d <= kReach; ++d) {
            EXPECT_FLOAT_EQ(out(15, row + d), out(15, row - d)) << row << " ± " << d;
            EXPECT_FLOAT_EQ(out(15, row + d), out(15 + d, row)) << row << " + " << d;
        }
    }
}

TEST(Filters, WideBlurOnAReducedCopyMeetsTheFullOne) {
    const Grid<float> luma = luma_plane(test::scene({300, 200}));
    const Grid<float> direct = blurred(blurred(luma, 7), 7), wide = blurred(luma, 7 * std::sqrt(2.0f));
    float worst = 0;
    for (std::size_t n = 0; n < wide.size(); ++n) worst = std::max(worst, std::abs(direct[n] - wide[n]));
    EXPECT_LT(worst, 0.03f);
}

TEST(Filters, RankAndPercentileAgree) {
    // Of one band, and of several.
    for (const int size : {100, 700'000}) {
        Grid<float> ramp({size, 1});
        for (int i = 0; i < size; ++i) ramp(i, 0) = float((std::int64_t{i} * 37) % size);
        const float bin = float(size) / 65536;
        EXPECT_NEAR(percentile(ramp, 50), 0.5f * float(size), 0.01f + 2 * bin);
        const Grid<float> r = rank(ramp);
        for (int i = 0; i < size; ++i) ASSERT_NEAR(r(i, 0), ramp(i, 0) / float(size), 1e-6f + 2 * bin / float(size));
    }
}

}  // namespace
}  // namespace dstylize
