#include <gtest/gtest.h>

#include "core/branching.h"
#include "stroke/strokes.h"
#include "stroke/widths.h"
#include "support/trees.h"

namespace dstylize {
namespace {

TEST(Warp, MovesNodesByNoMoreThanItsTwoAmplitudes) {
    const test::Tree tree = test::tree({80, 80}, 3, 30);
    StrokeParameters p;
    p.warp = 1.5f;
    Dendrite warped = tree.dendrite;
    warp(warped, {80, 80}, p, 1, 7);
    float most = 0;
    for (std::uint32_t v = 0; v < warped.size(); ++v) {
        const Vec2f by = warped.position_lattice[v] - tree.dendrite.position_lattice[v];
        ASSERT_LE(std::max(std::abs(by.x), std::abs(by.y)), 2.5f * p.warp + 1e-4f);
        most = std::max(most, length(by));
    }
    EXPECT_GT(most, p.warp);
    EXPECT_EQ(warped.parent, tree.dendrite.parent);
    p.warp = 0;
    warped = tree.dendrite;
    warp(warped, {80, 80}, p, 1, 7);
    EXPECT_EQ(warped.position_lattice, tree.dendrite.position_lattice);
}

TEST(Warp, IsKeyedByThePlaceInThePicture) {
    StrokeParameters p;
    p.warp = 2;
    Dendrite coarse, fine;
    coarse.add(NodeId{0}, {30, 40}, Dendrite::kRoot, 0, 0);
    fine.add(NodeId{0}, {60, 80}, Dendrite::kRoot, 0, 0);
    warp(coarse, {100, 100}, p, 0.5f, 7);
    warp(fine, {200, 200}, p, 1, 7);
    EXPECT_NEAR(2 * coarse.position_lattice[0].x, fine.position_lattice[0].x, 1e-3);
    EXPECT_NEAR(2 * coarse.position_lattice[0].y, fine.position_lattice[0].y, 1e-3);
}

/// Widths by one rule alone, of a tree that costs the same everywhere.
struct ByRule {
    test::Tree tree = test::tree({80, 80}, 5, 25);
    Branching b = branching(tree.dendrite);
    Grid<float> half{{80, 80}, 0.5f};

    std::vector<float> widths(WidthParameters p, const Grid<float>& sum) const {
        p.tone = 0;
        p.trunk = p.window = p.tip = 0;
        return Widths(tree.dendrite, b, p, {&half, half, &half, &sum, &half}, 1).widths();
    }
};

TEST(Widths, PathWidthFallsWithTheCostOfTheWay) {
    const ByRule rule;
    WidthParameters p;
    p.path = 1;
    p.path_alpha = 8;
    p.path_side = 1;
    const std::vector<float> w = rule.widths(p, rule.half);
    const Branch& trunk = rule.b.branches.front();
    // Away from the tip, which runs out by itself.
    for (std::size_t k = 1; k + 30 < trunk.nodes.size(); ++k)
        ASSERT_LE(w[trunk.nodes[k]], w[trunk.nodes[k - 1]] + 1e-4f);
    EXPECT_LT(w[trunk.nodes[trunk.nodes.size() / 2]], w[trunk.nodes[0]]);
    p.path_alpha = 30;
    const std::vector<float> narrower = rule.widths(p, rule.half);
    p.path_alpha = 8;
    p.path_side = 3;
    const std::vector<float> thin_sides = rule.widths(p, rule.half);
    double all = 0, all_narrower = 0, all_thin_sides = 0;
    for (std::uint32_t v = 0; v < w.size(); ++v)
        all += w[v], all_narrower += narrower[v], all_thin_sides += thin_sides[v];
    EXPECT_LT(all_narrower, 0.95 * all);
    EXPECT_LT(all_thin_sides, 0.95 * all);
}

TEST(Widths, FieldWidthFollowsItsFields) {
    const ByRule rule;
    WidthParameters p;
    p.field = 1;
    const std::vector<float> none = rule.widths(p, Grid<float>({80, 80}, 0.0f));
    const std::vector<float> full = rule.widths(p, Grid<float>({80, 80}, 1.0f));
    const std::uint32_t inside = rule.b.branches.front().nodes[5];
    EXPECT_FLOAT_EQ(none[inside], p.narrowest);
    EXPECT_FLOAT_EQ(full[inside], p.widest);
}

}  // namespace
}  // namespace dstylize
