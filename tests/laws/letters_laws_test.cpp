// What letters owe: every connected part of the mask its own connected dendrite, inside the shape but for the
// stated overflow, at the same proportions whatever the size.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "imaging/filters.h"
#include "imaging/skeleton.h"
#include "pipeline/style_file.h"
#include "pipeline/stylize.h"
#include "pipeline/writing.h"
#include "support/scenes.h"

namespace dstylize {
namespace {

class LetterStyle : public ::testing::TestWithParam<std::string> {
  protected:
    static Style style(const std::vector<Setting>& settings = {}) { return load_style(GetParam(), settings); }
    static Writing writing(const std::string& text, float size = 0) {
        Writing out;
        out.lettering.text = text;
        out.size = size;
        return out;
    }
    static Drawing drawn(const std::string& text, Extent size, float em = 0, Controls controls = {}) {
        controls.mask = letter_mask(writing(text, em), size);
        return stylize(test::flat(size, {128, 128, 128, 255}), style(), controls);
    }
    static Grid<std::uint8_t> solid(const Picture& mask, Extent extent) {
        const Grid<float> luma = resized(luma_plane(mask), extent);
        Grid<std::uint8_t> out(extent);
        std::transform(luma.begin(), luma.end(), out.begin(), [](float v) { return std::uint8_t(v >= 0.5f); });
        return out;
    }
};
INSTANTIATE_TEST_SUITE_P(Letters, LetterStyle, ::testing::Values("letters", "lichen-letters"));

TEST_P(LetterStyle, EveryPartHasItsOwnConnectedDendrite) {
    const Extent size{500, 200};
    const Drawing d = drawn("Jil\u00e9:", size);
    ASSERT_EQ(first_fault(d.dendrite), "");
    const Grid<int> part = nearest_part(solid(letter_mask(writing("Jil\u00e9:"), size), d.lattice));
    std::map<int, std::set<int>> owners_of_part;
    std::map<int, std::size_t> nodes_of_part;
    std::map<int, int> roots_of_part;
    for (std::uint32_t v = 0; v < d.dendrite.size(); ++v) {
        const int here = part[index(d.dendrite.node[v])];
        owners_of_part[here].insert(d.dendrite.owner[v]);
        ++nodes_of_part[here];
        if (d.dendrite.is_root(v)) ++roots_of_part[here];
    }
    ASSERT_EQ(owners_of_part.size(), 8u) << "J, i and its dot, l, e and its accent, the two points";
    std::set<int> all;
    for (const auto& [which, owners] : owners_of_part) {
        EXPECT_EQ(owners.size(), 1u);
        EXPECT_EQ(roots_of_part[which], 1);
        EXPECT_GT(nodes_of_part[which], 20u);
        all.insert(*owners.begin());
    }
    EXPECT_EQ(all.size(), 8u) << "no two parts share a root";
}

TEST_P(LetterStyle, NothingGrowsOutsideByMoreThanTheOverflow) {
    const Extent size{400, 200};
    const Drawing d = drawn("Roe", size);
    const Picture mask = letter_mask(writing("Roe"), size);
    const Style s = style();
    const float u = lattice_scale(size, s.lattice, &mask).nodes_per_u;
    const Grid<float> depth = signed_depth(solid(mask, d.lattice));
    for (const NodeId node : d.dendrite.node) ASSERT_GE(depth[index(node)], -s.fields.shape_overflow * u);
}

TEST_P(LetterStyle, ALetterIsDrawnAlikeWhateverItsSize) {
    const Drawing small = drawn("Ha", {300, 200}, 0.4f), large = drawn("Ha", {600, 400}, 0.8f);
    EXPECT_NEAR(double(small.strokes), double(large.strokes), 0.12 * double(large.strokes));
}

TEST_P(LetterStyle, AUsersRootIsTakenAndTheOtherPartsKeepTheirs) {
    Controls controls;
    controls.roots = {{{}, {0.5, true}, {0.5, true}}};
    const Drawing d = drawn("lil", {400, 200}, 0, controls);
    std::vector<Vec2f> roots;
    for (std::uint32_t v = 0; v < d.dendrite.size(); ++v)
        if (d.dendrite.is_root(v)) roots.push_back(d.dendrite.position_lattice[v]);
    ASSERT_EQ(roots.size(), 4u);
    const Vec2f middle{0.5f * float(d.lattice.x), 0.5f * float(d.lattice.y)};
    EXPECT_LT(distance(roots[0], middle), 0.08f * float(d.lattice.x));
}

TEST_P(LetterStyle, LettersWithHolesAreClosed) {
    const Drawing d = drawn("o", {300, 300});
    // A closed ring leaves the middle with ink all around: on every ray from it.
    const Vec2f middle{0.5f * float(d.lattice.x), 0.5f * float(d.lattice.y)};
    std::set<int> directions;
    for (std::uint32_t v = 0; v < d.dendrite.size(); ++v) {
        const Vec2f p = d.dendrite.position_lattice[v] - middle;
        directions.insert(int(std::floor((std::atan2(p.y, p.x) + 3.14159265f) / 6.2831854f * 72)));
    }
    EXPECT_GE(directions.size(), 72u);
}

}  // namespace
}  // namespace dstylize
