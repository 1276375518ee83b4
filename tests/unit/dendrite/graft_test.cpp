#include "dendrite/graft.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "support/trees.h"

namespace dstylize {
namespace {

TEST(Growth, EveryEndpointIsConnectedAndTheUnionIsAForest) {
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        const test::Tree t = test::tree({40, 30}, seed, 60);
        ASSERT_EQ(first_fault(t.dendrite), "");
        const std::set<NodeId> nodes(t.dendrite.node.begin(), t.dendrite.node.end());
        ASSERT_EQ(nodes.size(), t.dendrite.size()) << "a node appears twice";
        for (const NodeId endpoint : t.endpoints) ASSERT_TRUE(nodes.contains(endpoint));
        ASSERT_EQ(std::count(t.dendrite.parent.begin(), t.dendrite.parent.end(), Dendrite::kRoot), 1);
    }
}

TEST(Growth, EveryTipIsAnEndpoint) {
    const test::Tree t = test::tree({50, 50}, 3, 80);
    std::vector<bool> has_child(t.dendrite.size(), false);
    for (const std::uint32_t p : t.dendrite.parent)
        if (p != Dendrite::kRoot) has_child[p] = true;
    for (std::uint32_t v = 0; v < t.dendrite.size(); ++v)
        if (!has_child[v]) {
            ASSERT_NE(std::find(t.endpoints.begin(), t.endpoints.end(), t.dendrite.node[v]), t.endpoints.end());
        }
}

TEST(Growth, CarryGrowsWithTheWayFromTheRoot) {
    const Lattice lattice({10, 1}, Neighbourhood::square8);
    Growth growth(lattice);
    growth.add_root(lattice.at(0, 0), 7);
    const WeightedLattice graph{lattice, std::vector<NodeWeight>(10, 1), {}, true};
    const auto start = growth.sources(0, 0);
    const NodeId end = lattice.at(9, 0);
    growth.graft(reference_planner().plan({graph, start, Metric::sum, 0}, {}), {&end, 1}, 0);
    const auto sources = growth.sources(0.5, 10);
    ASSERT_EQ(sources.size(), 10u);
    for (std::size_t k = 0; k < 10; ++k) {
        EXPECT_EQ(sources[k].start, 5 * k);
        EXPECT_EQ(sources[k].owner, 7);
    }
}

TEST(Growth, EndpointsWithoutAPathAreCountedAndLeftOut) {
    const Lattice lattice({5, 1}, Neighbourhood::square4);
    const WeightedLattice graph{lattice, {1, 1, kImpassable, 1, 1}, {}, true};
    Growth growth(lattice);
    growth.add_root(lattice.at(0, 0), 0);
    const auto sources = growth.sources(0, 0);
    const std::vector<NodeId> endpoints{lattice.at(1, 0), lattice.at(4, 0)};
    EXPECT_EQ(growth.graft(reference_planner().plan({graph, sources, Metric::sum, 0}, {}), endpoints, 0), 1u);
    EXPECT_EQ(growth.dendrite().size(), 2u);
}

TEST(WithoutSpurs, DropsShortSideBranchesAndNothingElse) {
    const test::Tree t = test::tree({60, 60}, 9, 150);
    const Dendrite kept = without_spurs(t.dendrite, [](Vec2f) { return 6.0f; });
    ASSERT_EQ(first_fault(kept), "");
    ASSERT_LT(kept.size(), t.dendrite.size());
    std::vector<float> reach(kept.size(), 0);
    std::vector<std::multiset<float>> ways(kept.size());  // from each node, through each of its children
    for (std::size_t v = kept.size(); v-- > 1;) {
        if (kept.is_root(std::uint32_t(v))) continue;
        const std::uint32_t p = kept.parent[v];
        const float way = reach[v] + distance(kept.position_lattice[v], kept.position_lattice[p]);
        ways[p].insert(way);
        reach[p] = std::max(reach[p], way);
    }
    for (const auto& at_fork : ways) {
        if (at_fork.size() > 1) {
            ASSERT_GE(*at_fork.begin(), 6.0f - 1e-3f);
        }
    }
    EXPECT_EQ(without_spurs(t.dendrite, [](Vec2f) { return 0.0f; }).size(), t.dendrite.size());
}

TEST(Growth, ALayerSharesOnlyWhatTheFirstStagesGrew) {
    const Lattice lattice({12, 1}, Neighbourhood::square8);
    const WeightedLattice graph{lattice, std::vector<NodeWeight>(12, 1), {}, true};
    Growth growth(lattice);
    growth.add_root(lattice.at(0, 0), 0);
    const auto grow_to = [&](int column, std::uint8_t stage) {
        const std::vector<Source> sources = growth.sources(0, 1);
        const NodeId endpoint[] = {lattice.at(column, 0)};
        growth.graft(reference_planner().plan({graph, sources, Metric::sum, 0}, {}), endpoint, stage);
        return sources.size();
    };
    EXPECT_EQ(grow_to(3, 0), 1u);
    EXPECT_EQ(grow_to(6, 1), 4u);
    growth.start_layer(0);
    EXPECT_EQ(grow_to(8, 2), 4u) << "nodes 4 to 6 are grown a second time";
    EXPECT_EQ(growth.dendrite().size(), 4u + 3 + 5);
    EXPECT_EQ(first_fault(growth.dendrite()), "");
}

TEST(Growth, RefusedPathsAreNotGrown) {
    const Lattice lattice({12, 1}, Neighbourhood::square8);
    const WeightedLattice graph{lattice, std::vector<NodeWeight>(12, 1), {}, true};
    Growth growth(lattice);
    growth.add_root(lattice.at(0, 0), 0);
    const std::vector<Source> sources = growth.sources(0, 1);
    const NodeId endpoints[] = {lattice.at(3, 0), lattice.at(9, 0)};
    growth.graft(reference_planner().plan({graph, sources, Metric::sum, 0}, {}), endpoints, 0,
                 [](std::span<const NodeId> path) { return path.size() < 5; });
    EXPECT_EQ(growth.dendrite().size(), 4u);
}

TEST(Growth, BareTrunksStartBranchesDearer) {
    const Lattice lattice({10, 1}, Neighbourhood::square8);
    const WeightedLattice graph{lattice, std::vector<NodeWeight>(10, 1), {}, true};
    Growth growth(lattice);
    growth.add_root(lattice.at(0, 0), 0);
    const std::vector<Source> root = growth.sources(0, 1);
    const NodeId endpoint[] = {lattice.at(9, 0)};
    growth.graft(reference_planner().plan({graph, root, Metric::sum, 0}, {}), endpoint, 0);
    const std::vector<Source> sources = growth.sources(0, 10, 4);
    EXPECT_EQ(sources[0].start, 100u);
    EXPECT_EQ(sources[2].start, 50u);
    EXPECT_EQ(sources[4].start, 0u);
}

}  // namespace
}  // namespace dstylize
