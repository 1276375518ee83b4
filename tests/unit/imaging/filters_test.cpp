#include "imaging/filters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

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

TEST(Filters, PercentilesAreRanksOfUnevenSamplesToABin) {
    Grid<float> field({1000, 300});
    for (std::size_t n = 0; n < field.size(); ++n) field[n] = std::pow(float((n * 7919) % field.size()), 3.0f);
    std::vector<float> sorted(field.begin(), field.end());
    std::sort(sorted.begin(), sorted.end());
    const float bin = sorted.back() / 65536;
    for (const float percent : {0.0f, 1.0f, 2.0f, 33.3f, 50.0f, 97.0f, 98.5f, 99.99f}) {
        const auto rank = std::size_t(double(percent) / 100 * double(sorted.size()));
        EXPECT_NEAR(percentile(field, percent), sorted[rank], bin) << percent;
        EXPECT_EQ(percentiles(field, percent, 50).first, percentile(field, percent));
    }
    EXPECT_EQ(percentile(Grid<float>({9, 9}, 0.25f), 70), 0.25f) << "of one value";
}

TEST(Filters, AGradientIsTheSameWithinAndAcrossBandsOfRows) {
    Grid<float> waves({40, 500});
    for (int j = 0; j < 500; ++j)
        for (int i = 0; i < 40; ++i) waves(i, j) = std::sin(0.3f * float(i)) * std::cos(0.2f * float(j));
    const Grid<float> magnitude = gradient_magnitude(waves);
    const Derivatives d = derivatives(waves);
    for (int j = 1; j < 499; ++j)
        for (int i = 1; i < 39; ++i) {
            const auto at = [&](int x, int y) { return double(waves(i + x, j + y)); };
            const double dx = (at(1, -1) + 2 * at(1, 0) + at(1, 1) - at(-1, -1) - 2 * at(-1, 0) - at(-1, 1)) / 8;
            const double dy = (at(-1, 1) + 2 * at(0, 1) + at(1, 1) - at(-1, -1) - 2 * at(0, -1) - at(1, -1)) / 8;
            ASSERT_NEAR(double(d.x(i, j)), dx, 1e-5) << i << " " << j;
            ASSERT_NEAR(double(d.y(i, j)), dy, 1e-5) << i << " " << j;
            ASSERT_NEAR(double(magnitude(i, j)), std::hypot(dx, dy), 1e-5) << i << " " << j;
        }
}

}  // namespace
}  // namespace dstylize
