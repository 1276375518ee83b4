// Irregular lattices: every node has its 12 nearest, edges go both ways and not through walls, and the
// planners find on them what a brute-force fixed point finds.
#include "graph/scattered_lattice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>

#include "graph/bucket_planner.h"
#include "graph/edge_count.h"
#include "graph/height_planes.h"
#include "graph/tile_planner.h"
#include "laws/random_graphs.h"
#include "support/sanitized.h"

namespace dstylize {
namespace {

using test::open_ground;

Lattice lattice(const Grid<std::uint8_t>& passable, std::uint64_t seed) {
    return scattered_lattice(passable.extent(), passable, Noise(seed, Purpose::jitter), {});
}

bool lists(const Adjacency& a, std::uint32_t from, std::uint32_t to) {
    return std::find(a.to.begin() + a.first[from], a.to.begin() + a.first[from + 1], to) !=
           a.to.begin() + a.first[from + 1];
}

TEST(ScatteredLattice, EveryNodeIsJoinedToItsTwelveNearestAndBothWays) {
    const Lattice l = lattice(open_ground({23, 17}), 3);
    const Adjacency& a = *l.adjacency();
    for (std::uint32_t n = 0; n < l.node_count(); ++n) {
        std::vector<std::pair<float, std::uint32_t>> others;
        for (std::uint32_t v = 0; v < l.node_count(); ++v) {
            const Vec2f d = a.position_lattice[v] - a.position_lattice[n];
            if (v != n) others.push_back({dot(d, d), v});
        }
        std::sort(others.begin(), others.end());
        for (int k = 0; k < 12; ++k) ASSERT_TRUE(lists(a, n, others[std::size_t(k)].second)) << n;
        for (std::uint32_t e = a.first[n]; e < a.first[n + 1]; ++e) {
            ASSERT_NE(a.to[e], n);
            ASSERT_TRUE(lists(a, a.to[e], n));
            ASSERT_NEAR(a.length5[e], 5 * distance(a.position_lattice[n], a.position_lattice[a.to[e]]), 0.51f);
        }
    }
}

TEST(ScatteredLattice, NodesStayNearTheirCellsAndInsideTheFrame) {
    const Lattice l = lattice(open_ground({40, 30}), 1);
    for (std::uint32_t n = 0; n < l.node_count(); ++n) {
        const Vec2f p = l.position_lattice(NodeId{n});
        ASSERT_LE(std::abs(p.x - float(l.column(NodeId{n})) - 0.5f), 0.751f);
        ASSERT_LE(std::abs(p.y - float(l.row(NodeId{n})) - 0.5f), 0.501f);
        ASSERT_TRUE(p.x >= 0 && p.y >= 0 && p.x <= 40 && p.y <= 30);
    }
}

TEST(ScatteredLattice, NoEdgePassesThroughAWall) {
    Grid<std::uint8_t> passable = open_ground({30, 20});
    for (int j = 0; j < 20; ++j) passable(15, j) = 0;
    const Lattice l = lattice(passable, 2);
    const Adjacency& a = *l.adjacency();
    for (std::uint32_t n = 0; n < l.node_count(); ++n)
        for (std::uint32_t e = a.first[n]; e < a.first[n + 1]; ++e)
            ASSERT_EQ(a.position_lattice[n].x < 15, a.position_lattice[a.to[e]].x < 15);
}

test::RandomGraph scattered_graph(std::uint32_t seed, int largest_side = 14) {
    test::Dice dice(seed);
    const Extent e{dice.between(1, largest_side), dice.between(1, largest_side)};
    return test::random_graph_on(lattice(open_ground(e), seed), seed);
}

TEST(ScatteredLattice, ThePlannersAgreeBitForBit) {
    for (std::uint32_t seed = 0; seed < 600; ++seed) {
        const test::RandomGraph g = scattered_graph(seed);
        for (const Metric metric : {Metric::sum, Metric::max_sum, Metric::lexicographic, Metric::blend}) {
            const PlanRequest request{g.graph, g.sources, metric, 500};
            const Plan expected = reference_planner().plan(request, {}), found = bucket_planner().plan(request, {});
            ASSERT_EQ(found.label, expected.label) << seed;
            ASSERT_EQ(found.parent, expected.parent) << seed;
            ASSERT_EQ(found.owner, expected.owner) << seed;
        }
    }
}

/// Whether the tiles did it is checked, too: a planner that always asks another one agrees with it.
void expect_reference_answer_by_tiles(const test::RandomGraph& g, int threads, bool by_tiles, std::uint32_t seed) {
    const PlanRequest request{g.graph, g.sources, Metric::sum};
    Work work;
    work.threads = threads;
    TileStats stats;
    const Plan expected = reference_planner().plan(request, {}), found = plan_by_tiles(request, work, stats);
    ASSERT_EQ(stats.tiles > 0, by_tiles) << seed;
    ASSERT_NO_FATAL_FAILURE(test::expect_same_plan(found, expected, std::to_string(seed)));
}

TEST(ScatteredLattice, TilesAgreeWithTheReference) {
    for (std::uint32_t seed = 2000; seed < 2000 + test::fewer_if_sanitized(1000); ++seed)
        ASSERT_NO_FATAL_FAILURE(expect_reference_answer_by_tiles(scattered_graph(seed), 1, true, seed));
    for (std::uint32_t seed = 4000; seed < 4000 + test::fewer_if_sanitized(40); ++seed)
        ASSERT_NO_FATAL_FAILURE(
            expect_reference_answer_by_tiles(scattered_graph(seed, 280), 1 + int(seed % 3), true, seed));
}

TEST(ScatteredLattice, TilesKeepEqualLabelsAndManyOwnersApart) {
    test::RandomGraph g = scattered_graph(5000, 14);
    g.graph.lattice = lattice(open_ground({200, 130}), 5);
    g.graph.height_plane.clear();
    g.graph.weight.assign(200 * 130, 1);
    g.sources.clear();
    for (std::uint32_t k = 0; k < 300; ++k) g.sources.push_back({NodeId{k * 83}, k % 3, std::uint16_t(65534 - k)});
    for (const int threads : {1, 4}) ASSERT_NO_FATAL_FAILURE(expect_reference_answer_by_tiles(g, threads, true, 0));
}

TEST(ScatteredLattice, TilesUseLabelsAgainWhenSourcesHaveCome) {
    for (std::uint32_t seed = 6000; seed < 6000 + test::fewer_if_sanitized(400); ++seed) {
        const test::RandomGraph g = scattered_graph(seed, seed % 20 == 0 ? 150 : 14);
        const Plan before = tile_planner().plan({g.graph, g.sources, Metric::sum}, {});
        std::vector<Source> more(g.sources);
        test::Dice dice(seed);
        const std::uint32_t nodes = std::uint32_t(g.graph.lattice.node_count());
        for (int k = 0; k < 4; ++k)
            if (const NodeId n{dice.below(nodes)}; g.graph.passable(n)) {
                // Half of them start with the label that they have.
                const std::uint64_t label = before.label[index(n)].sum;
                more.push_back({n, dice.one_in(2) && label < 100000 ? label : dice.below(300), 9});
            }
        const PlanRequest request{g.graph, more, Metric::sum, 5000, &before, g.sources};
        const Plan expected = reference_planner().plan(request, {}), found = tile_planner().plan(request, {});
        ASSERT_NO_FATAL_FAILURE(test::expect_same_plan(found, expected, std::to_string(seed)));
    }
}

TEST(ScatteredLattice, SumsThatDoNotFit32BitsAreLeftToAnotherPlanner) {
    test::RandomGraph g = scattered_graph(7000);
    g.graph.lattice = lattice(open_ground({70, 5}), 7);
    g.graph.height_plane.clear();
    g.graph.weight.assign(350, 255);
    for (const std::uint64_t start : {0xffff0000ull - 300000, 0xffff0000ull, 0xfffffffeull, 0x100000000ull}) {
        g.sources = {{NodeId{0}, start, 1}};
        ASSERT_NO_FATAL_FAILURE(expect_reference_answer_by_tiles(g, 1, start < 0xffff0000ull, 0));
    }
}

TEST(ScatteredLattice, EdgesThatLeadFarAreLeftToAnotherPlanner) {
    for (const std::uint32_t far : {15u, 17u, 90u, 199u}) {
        auto adjacency = std::make_shared<Adjacency>(*lattice(open_ground({200, 3}), 6).adjacency());
        // The last edge of node 0, which is on no other path.
        const std::uint32_t edge = adjacency->first[1] - 1;
        adjacency->to[edge] = far;
        adjacency->length5[edge] = 1;
        test::RandomGraph g;
        g.graph.lattice = Lattice({200, 3}, adjacency);
        g.graph.weight.assign(600, 7);
        g.sources = {{NodeId{0}, 0, 0}};
        ASSERT_NO_FATAL_FAILURE(expect_reference_answer_by_tiles(g, 1, far < 70, far));
    }
}

/// Least sums by relaxing every edge until nothing changes.
std::vector<std::uint64_t> least_sums(const test::RandomGraph& g) {
    std::vector<std::uint64_t> least(g.graph.lattice.node_count(), PathLabel::kUnreached);
    for (const Source& s : g.sources) least[index(s.node)] = std::min(least[index(s.node)], s.start);
    for (bool changes = true; changes;) {
        changes = false;
        for (std::uint32_t u = 0; u < least.size(); ++u) {
            if (least[u] == PathLabel::kUnreached) continue;
            for (int s = 0; s < g.graph.degree(NodeId{u}); ++s) {
                const std::uint64_t height = g.graph.height(NodeId{u}, s);
                const std::uint32_t v = index(g.graph.neighbour(NodeId{u}, s));
                const std::uint64_t reached = least[u] + height * g.graph.length5(NodeId{u}, s);
                if (height == 0 || reached >= least[v]) continue;
                least[v] = reached;
                changes = true;
            }
        }
    }
    return least;
}

TEST(ScatteredLattice, SumsAreTheLeastThereAre) {
    for (std::uint32_t seed = 1000; seed < 1200; ++seed) {
        const test::RandomGraph g = scattered_graph(seed);
        const Plan plan = reference_planner().plan({g.graph, g.sources, Metric::sum, 0}, {});
        const std::vector<std::uint64_t> least = least_sums(g);
        for (std::size_t n = 0; n < least.size(); ++n) ASSERT_EQ(plan.label[n].sum, least[n]) << seed;
    }
}

TEST(ScatteredLattice, PullMakesOneWayDearer) {
    EXPECT_FLOAT_EQ(pull_factor({0, -1}, {0, -0.5f}), 1);
    EXPECT_FLOAT_EQ(pull_factor({0, 2}, {0, -0.5f}), 1.5f);
    EXPECT_FLOAT_EQ(pull_factor({3, 0}, {0, -0.5f}), 1.25f);
}

TEST(EdgeCount, IsTheFewestEdgesAndStopsAtTheLimit) {
    const Lattice square({9, 9}, Neighbourhood::square4);
    const WeightedLattice graph{square, std::vector<NodeWeight>(81, 1), {}, true};
    const NodeId middle[] = {square.at(4, 4)};
    const Grid<std::uint16_t> edges = edge_count(graph, middle, 5);
    for (int j = 0; j < 9; ++j)
        for (int i = 0; i < 9; ++i) EXPECT_EQ(edges(i, j), std::min(6, std::abs(i - 4) + std::abs(j - 4)));
}

}  // namespace
}  // namespace dstylize
