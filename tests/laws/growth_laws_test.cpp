// How stages grow on what the ones before them drew, and on every kind of lattice.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/style_file.h"
#include "pipeline/stylize.h"
#include "support/scenes.h"

namespace dstylize {
namespace {

constexpr Extent kSquare{240, 240};
constexpr const char* kTrunkAndTwig = R"([style]
name = "fork"
metaphor = "ink"
[lattice]
kind = "scattered"
detail = 240
[[stage]]
name = "trunk"
metric = "sum"
cost_max = 2
[[stage]]
name = "twig"
metric = "sum"
cost_max = 2
)";

/// A trunk straight up through the middle of even ground, then a twig to a point right of it.
Drawing fork(const char* earlier_paths, double twig_x, double twig_y) {
    Controls controls;
    controls.roots = {{{}, {0.5, true}, {0.95, true}}};
    controls.endpoints = {{{0.5, true}, {0.05, true}, "trunk"}, {{twig_x, true}, {twig_y, true}, "twig"}};
    const Style style = parse_style(kTrunkAndTwig, "s.toml", {{"stage.twig.earlier_paths", earlier_paths}});
    return stylize(test::flat(kSquare, {128, 128, 128, 255}), style, controls);
}

/// From the root, as a share of the lattice, where the first node of the second stage joins the first.
Vec2f joint(const Drawing& d) {
    for (std::uint32_t v = 0; v < d.dendrite.size(); ++v)
        if (d.dendrite.stage[v] == 1) {
            const Vec2f at = d.dendrite.position_lattice[d.dendrite.parent[v]];
            return {at.x / float(d.lattice.x), at.y / float(d.lattice.y)};
        }
    return {};
}

TEST(Growth, PathsLeaveEarlierOnesAtTheAngleWhoseCosineIsWhatThoseCost) {
    for (const auto& [share, text] : {std::pair{0.9, "0.9"}, {0.7, "0.7"}, {0.5, "0.5"}, {0.3, "0.3"}}) {
        // From the joint at half the trunk's height, by that angle.
        const double angle = std::acos(share), away = share > 0.8 ? 0.2 : 0.3;
        const Vec2f at = joint(fork(text, 0.5 + away, 0.5 - away / std::tan(angle)));
        EXPECT_NEAR(at.x, 0.5f, 0.03f) << share;
        // Where it joins decides little about costs, so random lengths of edges move it.
        EXPECT_NEAR(at.y, 0.5f, 0.12f) << share;
    }
    EXPECT_GT(joint(fork("1", 0.8, 0.5)).y, 0.8f) << "as dear as any ground, the trunk leads nobody";
}

TEST(Growth, EveryLatticeCarriesAForestThatReachesItsEndpoints) {
    const std::vector<std::pair<const char*, const char*>> lattices{
        {"regular", "0"}, {"regular", "1"}, {"hexagon", "0"}, {"hexagon", "0.4"}, {"scattered", "0"}};
    std::vector<std::vector<NodeId>> drawn;
    for (const auto& [kind, jitter] : lattices) {
        const Style style =
            load_style("vine", {{"lattice.detail", "200"}, {"lattice.kind", kind}, {"lattice.jitter", jitter}});
        const Drawing d = stylize(test::scene({160, 120}), style, {});
        EXPECT_EQ(first_fault(d.dendrite), "") << kind;
        EXPECT_EQ(d.unreached, 0u) << kind;
        EXPECT_GT(d.strokes, 100u) << kind;
        for (const auto& other : drawn) EXPECT_NE(d.dendrite.node, other) << kind << " " << jitter;
        drawn.push_back(d.dendrite.node);
    }
}

}  // namespace
}  // namespace dstylize
