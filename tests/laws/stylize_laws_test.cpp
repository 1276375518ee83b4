// What every drawing owes, whatever the style: it is a forest, connected, inside its mask, the same for
// any number of threads, and coarse and fine agree.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.h"
#include "imaging/filters.h"
#include "pipeline/style_file.h"
#include "pipeline/stylize.h"
#include "render/raster.h"
#include "support/quick_style.h"
#include "support/scenes.h"

namespace dstylize {
namespace {

class EveryStyle : public ::testing::TestWithParam<std::string> {
  protected:
    static Style style(int detail = 200) {
        return test::quick_style(GetParam(), {{"lattice.detail", std::to_string(detail)}});
    }
    static Drawing drawing(const Picture& picture, const Controls& controls = {}, int threads = 0) {
        Work work;
        work.threads = threads;
        return stylize(picture, style(), controls, work);
    }
};
std::vector<std::string> all_styles() {
    std::vector<std::string> names;
    for (const BuiltinStyle& style : builtin_styles()) names.emplace_back(style.name);
    return names;
}
INSTANTIATE_TEST_SUITE_P(Builtin, EveryStyle, ::testing::ValuesIn(all_styles()));

TEST_P(EveryStyle, DrawsAForestWithWidths) {
    const Drawing d = drawing(test::scene({160, 120}));
    EXPECT_EQ(first_fault(d.dendrite), "");
    EXPECT_EQ(d.width_u.size(), d.dendrite.size());
    EXPECT_EQ(d.unreached, 0u);
    EXPECT_GT(d.strokes, 20u);
    for (const float w : d.width_u) ASSERT_TRUE(std::isfinite(w) && w > 0);
}

TEST_P(EveryStyle, IsTheSameForAnyNumberOfThreads) {
    const Picture picture = test::scene({160, 120});
    const Drawing one = drawing(picture, {}, 1), three = drawing(picture, {}, 3);
    EXPECT_EQ(one.dendrite.node, three.dendrite.node);
    EXPECT_EQ(one.dendrite.position_lattice, three.dendrite.position_lattice);
    EXPECT_EQ(one.width_u, three.width_u);
    EXPECT_EQ(raster(one.list, {{160, 120}}, {}), raster(three.list, {{160, 120}}, {}));
}

TEST_P(EveryStyle, SeedsDiffer) {
    const Picture picture = test::scene({160, 120});
    Controls other;
    other.seed = 2;
    EXPECT_NE(drawing(picture).dendrite.node, drawing(picture, other).dendrite.node);
}

TEST_P(EveryStyle, TheMaskIsRespectedAndEveryPartHasItsRoot) {
    Controls controls;
    controls.mask = test::flat({160, 120}, {0, 0, 0, 255});
    for (int j = 10; j < 110; ++j)
        for (int i = 10; i < 150; ++i)
            if (i < 70 || i > 90) (*controls.mask)(i, j) = {255, 255, 255, 255};
    const Drawing d = drawing(test::scene({160, 120}), controls);
    std::set<std::uint32_t> sides;
    for (std::uint32_t v = 0; v < d.dendrite.size(); ++v) {
        const float x = float(index(d.dendrite.node[v]) % std::uint32_t(d.lattice.x)) / float(d.lattice.x) * 160;
        ASSERT_TRUE(x < 71 || x > 89) << x;
        if (d.dendrite.is_root(v)) sides.insert(x < 80);
    }
    EXPECT_EQ(sides.size(), 2u) << "one root per connected part";
}

TEST_P(EveryStyle, RootsAreWhereTheUserPutsThem) {
    Controls controls;
    controls.roots = {{{}, {0.25, true}, {0.5, true}}, {RootParameters::Place::top, {}, {}}};
    const Drawing d = drawing(test::scene({160, 120}), controls);
    std::vector<Vec2f> roots;
    for (std::uint32_t v = 0; v < d.dendrite.size(); ++v)
        if (d.dendrite.is_root(v)) roots.push_back(d.dendrite.position_lattice[v]);
    ASSERT_EQ(roots.size(), 2u);
    EXPECT_LT(distance(roots[0], {50, 75}), 12);
    EXPECT_LT(roots[1].y, 20);
}

TEST_P(EveryStyle, BadRootsAreRefused) {
    Controls outside, masked;
    outside.roots = {{{}, {500, false}, {5, false}}};
    EXPECT_THROW(drawing(test::scene({160, 120}), outside), Error);
    masked.roots = {{{}, {0.5, true}, {0.5, true}}};
    masked.mask = test::scene({160, 120});  // dark in the middle: nothing may grow there
    (*masked.mask)(80, 66) = {0, 0, 0, 255};
    EXPECT_THROW(drawing(test::scene({160, 120}), masked), Error);
}

TEST_P(EveryStyle, GivenEndpointsAreTheOnlyOnes) {
    Controls controls;
    controls.endpoints = {{{0.2, true}, {0.3, true}, ""}, {{0.8, true}, {0.3, true}, ""}};
    const Drawing d = drawing(test::scene({160, 120}), controls);
    EXPECT_EQ(d.endpoints[0], 2u);
    EXPECT_LE(d.strokes, 2u);
}

TEST_P(EveryStyle, OddPicturesGiveADrawingOrAnError) {
    for (const Extent size : {Extent{1, 1}, Extent{1, 400}, Extent{400, 1}, Extent{3, 2}}) {
        const Drawing d = drawing(test::scene(size));
        EXPECT_EQ(first_fault(d.dendrite), "") << size.x << "x" << size.y;
    }
    for (const std::uint8_t v : {0, 128, 255})
        EXPECT_EQ(first_fault(drawing(test::flat({50, 50}, {v, v, v, 255})).dendrite), "");
    EXPECT_THROW(drawing(test::flat({50, 50}, {9, 9, 9, 0})), Error);
    Controls black;
    black.mask = test::flat({5, 5}, {0, 0, 0, 255});
    EXPECT_THROW(drawing(test::scene({160, 120}), black), Error);
}

TEST_P(EveryStyle, HalfTheDetailIsAnHonestPreview) {
    const Picture picture = test::scene({320, 240});
    const auto tone = [&](int detail) {
        const Drawing d = stylize(picture, style(detail), {});
        return blurred(luma_plane(raster(d.list, {{320, 240}}, {})), 0.02f * 320);
    };
    const Grid<float> full = tone(640), half = tone(320);
    double mf = 0, mh = 0, fh = 0, ff = 0, hh = 0;
    for (std::size_t n = 0; n < full.size(); ++n) mf += full[n], mh += half[n];
    mf /= double(full.size()), mh /= double(half.size());
    for (std::size_t n = 0; n < full.size(); ++n)
        fh += (full[n] - mf) * (half[n] - mh), ff += (full[n] - mf) * (full[n] - mf),
            hh += (half[n] - mh) * (half[n] - mh);
    EXPECT_GT(fh / std::sqrt(ff * hh), 0.9);
}

TEST_P(EveryStyle, EveryIntermediateCanBeShown) {
    const Picture picture = test::scene({120, 90});
    const Style s = style(100);
    const std::vector<std::string> names = shown_names(s);
    const std::vector<Picture> pictures = shown(names, picture, s, {});
    ASSERT_EQ(pictures.size(), names.size());
    for (std::size_t k = 0; k < names.size(); ++k) EXPECT_EQ(pictures[k].extent(), (Extent{100, 75})) << names[k];
    EXPECT_EQ(shown({"tree"}, picture, s, {}).front(), pictures.back()) << "one of many is the one alone";
    EXPECT_THROW(shown({"nothing"}, picture, s, {}), Error);
}

TEST(Vine, TheDrawnToneFollowsThePicture) {
    const Picture picture = test::scene({320, 240});
    const Drawing d = stylize(picture, load_style("vine", {{"lattice.detail", "640"}}), {});
    const Grid<float> drawn = blurred(luma_plane(raster(d.list, {{320, 240}}, {})), 8),
                      wanted = blurred(luma_plane(picture), 8);
    EXPECT_LT(drawn(110, 130), 0.45f) << "the dark side of the disc";
    EXPECT_GT(drawn(40, 200), 0.8f) << "the calm ground";
    EXPECT_GT(wanted(40, 200) - wanted(110, 130), 0.5f);
}

/// Two dark discs on a light ground, where the crown of a tree will be.
Picture two_discs(Extent size) {
    Picture out(size, {235, 235, 235, 255});
    for (int j = 0; j < size.y; ++j)
        for (int i = 0; i < size.x; ++i) {
            const float x = (float(i) + 0.5f) / float(size.x), y = (float(j) + 0.5f) / float(size.y);
            const bool dark = std::hypot(x - 0.72f, y - 0.42f) < 0.11f || std::hypot(x - 0.52f, y - 0.22f) < 0.09f;
            if (dark) out(i, j) = {30, 30, 30, 255};
        }
    return out;
}

/// Correlation of a drawing's darkness with the picture's, in the part of the crown where it leads.
double resemblance(const Picture& picture, const Drawing& d) {
    const float sigma = 0.02f * float(picture.extent().long_side());
    const Grid<float> drawn = blurred(luma_plane(raster(d.list, {picture.extent()}, {})), sigma);
    const Grid<float> wanted = blurred(luma_plane(picture), sigma);
    double n = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
    const Extent e = picture.extent();
    for (int j = e.y / 10; j < e.y * 6 / 10; ++j)
        for (int i = e.x * 4 / 10; i < e.x * 85 / 100; ++i) {
            const auto a = double(wanted(i, j)), b = double(drawn(i, j));
            n += 1, x += a, y += b, xx += a * a, yy += b * b, xy += a * b;
        }
    return (n * xy - x * y) / std::sqrt((n * xx - x * x) * (n * yy - y * y));
}

TEST(Pareidolia, TheMoreLikenessTheMoreTheDrawingResemblesThePicture) {
    const Picture picture = two_discs({300, 300});
    double before = -1;
    for (const char* likeness : {"0", "0.3", "0.6", "1"}) {
        const Style s = load_style("pareidolia", {{"lattice.detail", "300"},
                                                  {"lattice.picture_scale", "1"},
                                                  {"lattice.picture_x", "0.5"},
                                                  {"lattice.picture_y", "0.5"},
                                                  {"crown.likeness", likeness},
                                                  {"choice.growths", "1"}});
        const double now = resemblance(picture, stylize(picture, s, {}));
        EXPECT_GT(now, before + 0.02) << likeness;
        before = now;
        if (std::string_view(likeness) == "0") {
            EXPECT_LT(now, 0.45) << "without any it is only a tree";
        }
    }
    EXPECT_GT(before, 0.85);
}

TEST(Tree, WithoutAPictureItStillGrowsAndKnowsNothingOfIt) {
    Controls controls;
    controls.no_picture = true;
    const Style s = load_style("tree", {{"lattice.detail", "200"}});
    const Drawing one = stylize(test::scene({160, 160}), s, controls);
    const Drawing other = stylize(test::flat({160, 160}, {200, 10, 10, 255}), s, controls);
    EXPECT_GT(one.strokes, 100u);
    EXPECT_EQ(one.dendrite.node, other.dendrite.node);
}

TEST(Tree, WindBendsIt) {
    const auto lean = [](const char* wind) {
        Controls controls;
        controls.no_picture = true;
        const Drawing d = stylize(
            test::flat({160, 160}, {}),
            load_style("tree", {{"lattice.detail", "200"}, {"stage.twigs.wind", wind}, {"stage.limbs.wind", wind}}),
            controls);
        double sum = 0;
        for (std::uint32_t v = 0; v < d.dendrite.size(); ++v)
            if (!d.dendrite.is_root(v))
                sum += double(d.dendrite.position_lattice[v].x - d.dendrite.position_lattice[d.dendrite.parent[v]].x);
        return sum / double(d.dendrite.size());
    };
    EXPECT_GT(lean("1.5"), lean("0") + 0.02);
    EXPECT_LT(lean("-1.5"), lean("0") - 0.02);
}

}  // namespace
}  // namespace dstylize
