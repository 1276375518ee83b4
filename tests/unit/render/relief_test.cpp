#include <gtest/gtest.h>

#include "core/display_list.h"
#include "render/raster.h"

namespace dstylize {
namespace {

constexpr Rgba kGrey{0.5f, 0.5f, 0.5f, 1};

DisplayList rod(Rgba paper = kGrey) {
    DisplayList list{100, 60, {paper, 0, 1}, {}};
    Layer layer{
        "body", Blend::max, {VariableStroke{{{20, 30}, {50, 30}, {80, 30}}, {16, 16, 16}, {0.5f, 0.4f, 0.2f, 1}}}};
    Relief relief;
    relief.tip = {0.9f, 0.9f, 0.6f, 1};
    relief.radius_px = 8;
    relief.roughness = 0;
    relief.gap = 0;
    relief.light = {0, -0.8f};
    relief.shadow_length_px = 6;
    layer.relief = relief;
    list.layers.push_back(std::move(layer));
    return list;
}
int luma8(Rgba8 p) { return (p.r * 2 + p.g * 5 + p.b) / 8; }

TEST(Relief, TheSideTowardsTheLightIsBrighterAndTheShadowFallsOnTheOther) {
    const Picture p = raster(rod(), {{100, 60}}, {});
    EXPECT_GT(luma8(p(50, 26)), luma8(p(50, 34)) + 20);
    EXPECT_LT(luma8(p(50, 41)), 110) << "shadow below";
    EXPECT_GT(luma8(p(50, 41 - 22 - 3)), luma8(p(50, 41)) + 10) << "none above";
    EXPECT_NEAR(luma8(p(3, 3)), 128, 2) << "the ground far away is untouched";
}

TEST(Relief, StrokesTurnToTheTipColourAtTheirEnds) {
    const Picture p = raster(rod(), {{100, 60}}, {});
    EXPECT_GT(int(p(79, 29).g), int(p(40, 29).g) + 40);
}

TEST(Relief, OnATransparentGroundTheShadowIsAVeil) {
    const Picture p = raster(rod({0, 0, 0, 0}), {{100, 60}}, {});
    EXPECT_EQ(p(3, 3).a, 0);
    EXPECT_EQ(p(50, 30).a, 255);
    EXPECT_GT(int(p(50, 41).a), 30);
    EXPECT_LT(int(p(50, 41).a), 220);
}

TEST(Relief, DrapesOverTheGrainOfTheGround) {
    Picture striped({100, 60});
    for (int j = 0; j < 60; ++j)
        for (int i = 0; i < 100; ++i) striped(i, j) = i / 5 % 2 ? Rgba8{60, 60, 60, 255} : Rgba8{180, 180, 180, 255};
    const auto contrast = [&](float drape) {
        DisplayList list = rod();
        list.paper.picture = std::make_shared<Picture>(striped);
        list.layers[0].relief->drape = drape;
        const Picture p = raster(list, {{100, 60}}, {});
        return std::abs(luma8(p(42, 29)) - luma8(p(47, 29)));
    };
    EXPECT_GT(contrast(1), contrast(0) + 10);
    EXPECT_GT(contrast(1), 20);
}

TEST(Relief, IsTheSameForAnyNumberOfThreads) {
    Work one, three;
    one.threads = 1;
    three.threads = 3;
    EXPECT_EQ(raster(rod(), {{200, 120}}, one), raster(rod(), {{200, 120}}, three));
}

}  // namespace
}  // namespace dstylize
