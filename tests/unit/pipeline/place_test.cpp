// A place in a background as users write it, and where a drawing comes to lie in it.
#include "pipeline/place.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "pipeline/scene.h"

namespace dstylize {
namespace {

constexpr Extent kLand{400, 200};

void expect_box(const std::string& text, Vec2f corner, Vec2f size) {
    const Box box = placed_box(parsed_place(text), kLand);
    EXPECT_FLOAT_EQ(box.corner_px.x, corner.x) << text;
    EXPECT_FLOAT_EQ(box.corner_px.y, corner.y) << text;
    EXPECT_FLOAT_EQ(box.size_px.x, size.x) << text;
    EXPECT_FLOAT_EQ(box.size_px.y, size.y) << text;
}

TEST(Place, PartsWithADecimalPointAreSharesOfTheirSideOthersPixels) {
    expect_box("0.25,0.5,0.5,0.25", {100, 100}, {200, 50});
    expect_box("10,20,30,40", {10, 20}, {30, 40});
    expect_box("0.5,20,100,0.1", {200, 20}, {100, 20});
    expect_box("0,0,1.0,1.0", {0, 0}, {400, 200});
    expect_box("0.1,0.7,0.9,0.3", {40, 140}, {360, 60});  // sums that rounding takes past the edge
}

TEST(Place, ItsTextGivesItAgain) {
    for (const char* text : {"0.25,0.5,0.5,0.25", "10,20,30,40", "0,0,1.0,1.0", "0.5,20,100,0.125"}) {
        const Place place = parsed_place(text), again = parsed_place(place_text(place));
        const auto expect_same = [&](const Coordinate& a, const Coordinate& b) {
            EXPECT_EQ(a.value, b.value) << text;
            EXPECT_EQ(a.is_fraction, b.is_fraction) << text;
        };
        expect_same(place.x, again.x);
        expect_same(place.y, again.y);
        expect_same(place.width, again.width);
        expect_same(place.height, again.height);
    }
}

void expect_refused(const std::string& text, const std::string& why) {
    try {
        placed_box(parsed_place(text), kLand);
        ADD_FAILURE() << text << " was taken";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_usage) << text;
        EXPECT_NE(error.problem().find(why), std::string::npos) << text << ": " << error.problem();
        EXPECT_FALSE(error.remedy().empty()) << text;
    }
}

TEST(Place, WhatIsNoBoxInTheBackgroundIsRefused) {
    expect_refused("0.5", "not a box");
    expect_refused("0.1,0.2,0.3", "not a box");
    expect_refused("0.1,0.2,0.3,0.4,0.5", "not a box");
    for (const char* text : {"-1,0,5,5", "0,-0.1,0.5,0.5", "0,0,-5,5"}) expect_refused(text, "negative");
    for (const char* text : {"0,0,0,5", "0,0,5,0", "0.1,0.1,0.0,0.5"}) expect_refused(text, "zero");
    for (const char* text : {"0,0,401,5", "0,0,5,201", "0.6,0,0.5,0.5", "0,0.6,0.5,0.5"})
        expect_refused(text, "outside the background");
    for (const char* text : {"", "bottom", "a,b,c,d", "1,2,3,", "nan,0,1,1", "0,0,inf,1"}) expect_refused(text, "");
}

TEST(Placement, FitsIntoTheBoxAndStandsOnTheMiddleOfItsBottomEdge) {
    const DisplayList drawing{200, 100, {}, {}};
    const std::vector<Foot> feet{{{90, 80}, 5}, {{40, 60}, 3}};
    for (const Box& box : {Box{{20, 10}, {100, 100}}, Box{{7, 30}, {300, 40}}})
        for (const bool stands : {false, true}) {
            const Placement to = placement(drawing, feet, box, stands);
            const Vec2f corner = to.placed({0, 0}), ground = to.placed({100, stands ? 80.0f : 100.0f});
            EXPECT_NEAR(ground.x, box.corner_px.x + box.size_px.x / 2, 1e-3);
            EXPECT_NEAR(ground.y, box.corner_px.y + box.size_px.y, 1e-3);
            EXPECT_GE(corner.x, box.corner_px.x - 1e-3);
            EXPECT_GE(corner.y, box.corner_px.y - 1e-3);
            EXPECT_TRUE(corner.x < box.corner_px.x + 1e-3 || corner.y < box.corner_px.y + 1e-3) << "as large as fits";
        }
}

}  // namespace
}  // namespace dstylize
