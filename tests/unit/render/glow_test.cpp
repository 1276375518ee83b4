// Light: it adds and never clips, looks the same at every size, and becomes a picture of its own where
// there is nothing below.
#include <gtest/gtest.h>

#include <cmath>

#include "render/raster.h"

namespace dstylize {
namespace {

constexpr Extent kSize{120, 90};

/// A slanted stroke across a sheet, shining more and more along its way.
DisplayList bolt(Rgba paper, Glow glow) {
    DisplayList list{120, 90, {paper, 0, 0}, {}};
    VariableStroke stroke{{{20, 15}, {60, 50}, {100, 70}}, {4, 3, 2}, {1, 1, 1, 1}, 0, 0, {0.2f, 0.6f, 1}};
    list.layers.push_back({"light", Blend::max, {stroke}, std::move(glow)});
    return list;
}
Glow blue() {
    Glow glow;
    glow.halos = {{0.01f, {0.6f, 0.8f, 1, 1}, 0.8f}, {0.06f, {0.2f, 0.2f, 0.7f, 1}, 0.6f}};
    return glow;
}
Picture drawn(const DisplayList& list, Extent size = kSize, int threads = 0) {
    Work work;
    work.threads = threads;
    return raster(list, {size}, work);
}

TEST(Glow, OnlyAddsLight) {
    const Rgba paper{0.3f, 0.2f, 0.1f, 1};
    const Picture lit = drawn(bolt(paper, blue()));
    DisplayList bare = bolt(paper, blue());
    bare.layers.clear();
    const Picture dark = drawn(bare);
    int brighter = 0;
    for (std::size_t n = 0; n < lit.size(); ++n) {
        ASSERT_GE(lit[n].r, dark[n].r);
        ASSERT_GE(lit[n].g, dark[n].g);
        ASSERT_GE(lit[n].b, dark[n].b);
        brighter += lit[n].b > dark[n].b + 10;
    }
    EXPECT_GT(brighter, 300);
    EXPECT_GT(lit(60, 50).r, 150);
}

TEST(Glow, WithoutEmissionNothingChanges) {
    DisplayList list = bolt({0.3f, 0.2f, 0.1f, 1}, blue());
    std::get<VariableStroke>(list.layers[0].items[0]).emission = {0, 0, 0};
    const Picture lit = drawn(list);
    list.layers.clear();
    EXPECT_EQ(lit, drawn(list));
}

TEST(Glow, FollowsTheEmissionAlongTheStroke) {
    Glow core;
    const Picture lit = drawn(bolt({0, 0, 0, 1}, core));
    EXPECT_LT(lit(24, 19).r, lit(60, 50).r);
    EXPECT_LT(lit(60, 50).r, lit(96, 68).r);
    const double share = double(lit(60, 50).r) / 255;
    EXPECT_NEAR(share, 1 - std::exp(-core.exposure * 0.6), 0.03);
}

TEST(Glow, TheBrightestOfCrossingStrokesWins) {
    DisplayList list = bolt({0, 0, 0, 1}, {});
    VariableStroke dim{{{60, 10}, {60, 85}}, {6, 6}, {1, 1, 1, 1}, 0, 0, {0.1f, 0.1f}};
    const Picture alone = drawn(list);
    list.layers[0].items.push_back(dim);
    EXPECT_EQ(drawn(list)(60, 50), alone(60, 50));
}

TEST(Glow, OverNothingIsAPictureOfItsOwn) {
    const Picture clear = drawn(bolt({0, 0, 0, 0}, blue())), black = drawn(bolt({0, 0, 0, 1}, blue()));
    EXPECT_EQ(clear(2, 87).a < 20, true);
    EXPECT_GT(clear(60, 50).a, 150);
    for (std::size_t n = 0; n < clear.size(); ++n) {
        const auto over = [&](int c) { return (c * clear[n].a + 127) / 255; };
        ASSERT_NEAR(over(clear[n].r), black[n].r, 1);
        ASSERT_NEAR(over(clear[n].g), black[n].g, 1);
        ASSERT_NEAR(over(clear[n].b), black[n].b, 1);
    }
}

TEST(Glow, LooksTheSameAtEverySize) {
    const DisplayList list = bolt({0.1f, 0.1f, 0.1f, 1}, blue());
    const Picture small = drawn(list), large = drawn(list, {960, 720});  // the large one's halos are reduced
    double difference = 0;
    for (int y = 0; y < kSize.y; ++y)
        for (int x = 0; x < kSize.x; ++x) {
            double mean = 0;
            for (int j = 0; j < 8; ++j)
                for (int i = 0; i < 8; ++i) mean += large(8 * x + i, 8 * y + j).b;
            difference += std::abs(mean / 64 - small(x, y).b);
        }
    EXPECT_LT(difference / double(small.size()), 1.5);
}

TEST(Glow, DimsTheGroundAndCastsLightOnWhatIsNear) {
    Glow glow;
    glow.core_gain = 0;
    glow.ambient = 0.3f;
    glow.cast = 8;
    glow.cast_sigma = 0.05f;
    const Picture lit = drawn(bolt({0.5f, 0.5f, 0.5f, 1}, glow));
    EXPECT_LT(lit(5, 85).g, 64) << "far away";
    EXPECT_GT(lit(85, 62).g, lit(5, 85).g + 30) << "beside the bright end";
    EXPECT_GT(lit(85, 62).g, lit(30, 23).g) << "beside the dim end";
}

TEST(Glow, IsTheSameForAnyNumberOfThreads) {
    const DisplayList list = bolt({0.1f, 0.1f, 0.1f, 1}, blue());
    EXPECT_EQ(drawn(list, {700, 525}, 1), drawn(list, {700, 525}, 4));
}

TEST(Glow, PaintAboveLightStaysPaint) {
    DisplayList list = bolt({0, 0, 0, 1}, blue());
    list.layers.push_back(
        {"cover", Blend::over, {Fill{{{0, 0}, {120, 0}, {120, 90}, {0, 90}}, {0.2f, 0.4f, 0.6f, 1}}}});
    const Picture covered = drawn(list);
    EXPECT_EQ(covered(60, 50), (Rgba8{51, 102, 153, 255}));
    EXPECT_EQ(covered(5, 5), (Rgba8{51, 102, 153, 255}));
}

}  // namespace
}  // namespace dstylize
