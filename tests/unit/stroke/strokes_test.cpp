#include "stroke/strokes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "stroke/widths.h"
#include "support/trees.h"

namespace dstylize {
namespace {

TEST(Branching, CoversEveryEdgeExactlyOnce) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const Dendrite d = test::tree({45, 35}, seed, 70).dendrite;
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> covered;
        const Branching b = branching(d);
        for (const Branch& branch : b.branches)
            for (std::size_t k = 1; k < branch.nodes.size(); ++k) {
                ASSERT_EQ(d.parent[branch.nodes[k]], branch.nodes[k - 1]);
                ++covered[{branch.nodes[k - 1], branch.nodes[k]}];
            }
        std::size_t edges = 0;
        for (std::uint32_t v = 0; v < d.size(); ++v) edges += !d.is_root(v);
        ASSERT_EQ(covered.size(), edges);
        for (const auto& [edge, times] : covered) ASSERT_EQ(times, 1);
    }
}

TEST(Branching, ParentsComeFirstAndOrdersRiseByOne) {
    const Dendrite d = test::tree({60, 60}, 4, 120).dendrite;
    const Branching b = branching(d);
    for (std::uint32_t id = 0; id < b.branches.size(); ++id) {
        const Branch& branch = b.branches[id];
        if (branch.parent_branch == Branch::kNone) {
            ASSERT_EQ(branch.order, 0);
            continue;
        }
        ASSERT_LT(branch.parent_branch, id);
        ASSERT_EQ(branch.order, b.branches[branch.parent_branch].order + 1);
        const auto& parent = b.branches[branch.parent_branch].nodes;
        ASSERT_NE(std::find(parent.begin(), parent.end(), branch.nodes[0]), parent.end());
    }
    EXPECT_EQ(b.tips[0], std::uint32_t(b.branches.size()));
}

TEST(Smooth, KeepsRootsTipsAndJunctionsJoined) {
    Dendrite d = test::tree({60, 60}, 5, 80).dendrite;
    const Dendrite before = d;
    const Branching b = branching(d);
    smooth(d, b, 25);
    bool moved = false;
    for (std::uint32_t v = 0; v < d.size(); ++v) {
        if (d.is_root(v) || b.main_child[v] == Branching::kNone) {
            ASSERT_EQ(d.position_lattice[v], before.position_lattice[v]);
        }
        moved |= !(d.position_lattice[v] == before.position_lattice[v]);
    }
    EXPECT_TRUE(moved);
    for (const Centreline& line : centrelines(d, b, 5)) {
        const Branch& branch = b.branches[line.branch];
        ASSERT_EQ(line.points_lattice.size(), line.lead + branch.nodes.size());
        ASSERT_EQ(line.points_lattice.back(), d.position_lattice[branch.nodes.back()]) << "the tip stays";
        if (line.lead > 0) {
            std::uint32_t v = branch.nodes[0];
            for (std::uint32_t k = 0; k < line.lead; ++k) v = d.parent[v];
            ASSERT_EQ(line.points_lattice.front(), d.position_lattice[v]) << "the line starts on its parent";
        }
    }
}

struct Drawn {
    Dendrite dendrite = test::tree({80, 80}, 6, 120).dendrite;
    Branching b = branching(dendrite);
    Grid<float> tone{Extent{80, 80}, 0.6f}, lines{Extent{80, 80}, 0.0f}, importance{Extent{80, 80}, 0.5f};
    Widths widths(const WidthParameters& p, float u = 1) const {
        return Widths(dendrite, b, p, {&tone, importance, &lines}, u);
    }
};

TEST(Widths, TipsRunOutAndBranchesStartInsideTheirParents) {
    const Drawn drawn;
    WidthParameters p;
    p.tone = 0, p.importance = 1, p.trunk = 0;
    const Widths widths = drawn.widths(p);
    for (const Branch& branch : drawn.b.branches) {
        ASSERT_LE(widths.widths()[branch.nodes.back()], p.tip_width + 1e-4f);
        if (branch.parent_branch != Branch::kNone) {
            ASSERT_LE(widths.widths()[branch.nodes[1]], widths.widths()[branch.nodes[0]] + 0.2f);
        }
    }
}

TEST(Widths, EveryRuleStaysInItsRange) {
    const Drawn drawn;
    for (int rule = 0; rule < 5; ++rule) {
        WidthParameters p;
        p.tone = rule == 0 || rule == 4, p.importance = rule == 1 || rule == 4, p.branch = rule == 2 || rule == 4;
        p.constant = rule == 3 || rule == 4;
        p.trunk = 0;
        const Widths widths = drawn.widths(p);
        for (const float w : widths.widths()) ASSERT_TRUE(w > 0 && w <= p.widest * 1.3f) << rule << " " << w;
    }
}

TEST(Widths, DarkerTonesAreWider) {
    Drawn drawn;
    const Widths dark = drawn.widths({});
    drawn.tone = Grid<float>({80, 80}, 0.1f);
    const Widths light = drawn.widths({});
    double sum_dark = 0, sum_light = 0;
    for (std::uint32_t v = 0; v < drawn.dendrite.size(); ++v)
        sum_dark += dark.widths()[v], sum_light += light.widths()[v];
    EXPECT_GT(sum_dark, 1.5 * sum_light);
}

TEST(Widths, CorrectionWidensWhereInkIsMissing) {
    const Drawn drawn;
    WidthParameters p;
    p.trunk = 0;
    Widths widths = drawn.widths(p);
    const std::vector<float> before = widths.widths();
    widths.correct(Grid<float>({80, 80}, 0.5f), Grid<float>({80, 80}, 0.4f));
    for (std::uint32_t v = 0; v < before.size(); ++v) ASSERT_GE(widths.widths()[v], before[v] - 1e-5f);
    EXPECT_GT(widths.widths()[1], before[1]);
}

}  // namespace
}  // namespace dstylize
