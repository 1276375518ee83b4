// What the leaves of a tree owe: layers of light and shade, a closed crown, boughs in the gaps, and the picture's
// tones and hues at the picture's places.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "pipeline/style_file.h"
#include "pipeline/stylize.h"
#include "render/raster.h"
#include "support/quick_style.h"
#include "support/scenes.h"

namespace dstylize {
namespace {

constexpr Extent kCrown{300, 220};

Drawing autumn(const Picture& picture, const std::vector<Setting>& settings, bool no_picture = false) {
    std::vector<Setting> all{{"lattice.detail", "240"},
                             {"tree.leaf_fold", "0"},
                             {"stage.twigs.batches", "3"},
                             {"stage.twigs behind.batches", "1"}};
    all.insert(all.end(), settings.begin(), settings.end());
    Controls controls;
    controls.no_picture = no_picture;
    return stylize(picture, test::quick_style("autumn", all), controls);
}

std::vector<Fill> leaves(const Drawing& drawing, std::string_view layer) {
    std::vector<Fill> out;
    for (const Layer& l : drawing.list.layers)
        if (l.name == layer)
            for (const Item& item : l.items) out.push_back(std::get<Fill>(item));
    return out;
}

/// Mean of a value over the leaves that stand between two shares of the frame's width.
double mean(const std::vector<Fill>& leaves, float from, float to, const std::function<float(Rgba)>& value) {
    double sum = 0, n = 0;
    for (const Fill& leaf : leaves) {
        const float x = leaf.outline_px[0].x / float(kCrown.x);
        if (x >= from && x < to) sum += double(value(leaf.colour)), ++n;
    }
    EXPECT_GT(n, 10);
    return sum / n;
}

float redness(Rgba c) { return c.r - c.g; }

/// One colour on the left, another on the right, of the same luma.
Picture red_and_green() {
    Picture out = test::flat(kCrown, {190, 84, 84, 255});
    for (int j = 0; j < kCrown.y; ++j)
        for (int i = kCrown.x / 2; i < kCrown.x; ++i) out(i, j) = {70, 145, 85, 255};
    return out;
}

TEST(Foliage, LeavesBehindTheBranchesAreInTheShade) {
    const Drawing drawing = autumn(test::scene(kCrown), {});
    const double behind = mean(leaves(drawing, "leaves behind"), 0, 1, luma),
                 front = mean(leaves(drawing, "leaves"), 0, 1, luma);
    EXPECT_LT(behind, 0.75 * front);
    std::vector<std::string> names;
    for (const Layer& layer : drawing.list.layers) names.push_back(layer.name);
    const auto at = [&](const char* name) { return std::ranges::find(names, name) - names.begin(); };
    EXPECT_LT(at("leaves behind"), at("branches"));
    EXPECT_LT(at("branches"), at("leaves"));
}

TEST(Foliage, TheForemostLeavesComeLastAndAreTheLightest) {
    const std::vector<Fill> all =
        leaves(autumn(test::flat(kCrown, {128, 128, 128, 255}), {{"tree.leaf_depth", "0.8"}}), "leaves");
    const auto middle = all.begin() + std::ptrdiff_t(all.size() / 2);
    EXPECT_GT(mean({middle, all.end()}, 0, 1, luma), 1.2 * mean({all.begin(), middle}, 0, 1, luma));
}

TEST(Foliage, NoPaperShowsInTheMiddleOfTheCrown) {
    const auto paper = [](const std::vector<Setting>& settings) {
        const Picture out = raster(autumn(test::scene(kCrown), settings).list, {kCrown}, {});
        int n = 0;
        for (int y = 50; y < 130; ++y)
            for (int x = 90; x < 210; ++x) n += out(x, y).b > 200;
        return n;
    };
    const int open = paper({{"tree.leaf_fill", "0"}, {"tree.foliage", "0.2"}}),
              closed = paper({{"tree.leaf_fill", "1"}, {"tree.foliage", "0.2"}});
    EXPECT_GT(open, 100);
    EXPECT_LT(closed, open / 4);
}

TEST(Foliage, BoughsAreSeenWhereLeavesMakeRoom) {
    const auto front = [](const char* seen) {
        return leaves(autumn(test::scene(kCrown), {{"tree.boughs_seen", seen}}), "leaves").size();
    };
    EXPECT_LT(front("1"), front("0"));
}

TEST(Foliage, DarkPlacesHaveDarkLeaves) {
    Picture halves = test::flat(kCrown, {225, 225, 225, 255});
    for (int j = 0; j < kCrown.y; ++j)
        for (int i = kCrown.x / 2; i < kCrown.x; ++i) halves(i, j) = {30, 30, 30, 255};
    const std::vector<Fill> all = leaves(autumn(halves, {}), "leaves");
    EXPECT_GT(mean(all, 0.2f, 0.5f, luma), 2 * mean(all, 0.6f, 0.8f, luma));
}

TEST(Foliage, LeavesHaveThePicturesHuesWhereThePictureIs) {
    const auto redder = [](const char* own_hue, bool no_picture = false) {
        const std::vector<Fill> all = leaves(
            autumn(red_and_green(), {{"tree.own_hue", own_hue}, {"tree.green_share", "0"}}, no_picture), "leaves");
        // The picture is set into the frame: its middle is right of the frame's, at 0.54.
        return mean(all, 0.3f, 0.53f, redness) - mean(all, 0.56f, 0.8f, redness);
    };
    EXPECT_GT(redder("1"), 0.25);
    EXPECT_NEAR(redder("0"), 0, 0.06);
    EXPECT_NEAR(redder("1", true), 0, 0.06);
}

TEST(Foliage, SomeLeavesAreStillGreen) {
    const auto greens = [](const char* share) {
        const std::vector<Fill> all = leaves(
            autumn(test::flat(kCrown, {128, 128, 128, 255}), {{"tree.green_share", share}, {"tree.hue_variety", "0"}}),
            "leaves");
        return double(
                   std::ranges::count_if(all, [](const Fill& leaf) { return leaf.colour.r < 1.06f * leaf.colour.g; })) /
               double(all.size());
    };
    EXPECT_LT(greens("0"), 0.01);
    EXPECT_GT(greens("0.5"), 0.25);
    EXPECT_LT(greens("0.5"), 0.75);
    EXPECT_GT(greens("1"), 0.95);
}

}  // namespace
}  // namespace dstylize
