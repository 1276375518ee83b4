// Lattices of regular pattern whose edges are listed: who is joined to whom, how long edges are, and that the planners
// agree on them; the turn penalty, which needs a lattice that is no square one.
#include "graph/listed_lattices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "core/error.h"
#include "graph/bucket_planner.h"
#include "graph/scattered_lattice.h"
#include "graph/tile_planner.h"
#include "laws/random_graphs.h"
#include "support/sanitized.h"

namespace dstylize {
namespace {

using test::Dice;
using test::open_ground;

Noise jitter(std::uint64_t seed) { return Noise(seed, Purpose::jitter); }

void expect_edges_go_both_ways_and_are_as_long_as_they_are(const Lattice& l) {
    const Adjacency& a = *l.adjacency();
    for (std::uint32_t n = 0; n < l.node_count(); ++n)
        for (std::uint32_t e = a.first[n]; e < a.first[n + 1]; ++e) {
            ASSERT_NE(a.to[e], n);
            ASSERT_NEAR(a.length5[e], std::max(1.f, 5 * distance(a.position_lattice[n], a.position_lattice[a.to[e]])),
                        0.51f);
            const auto back = std::find(a.to.begin() + a.first[a.to[e]], a.to.begin() + a.first[a.to[e] + 1], n);
            ASSERT_NE(back, a.to.begin() + a.first[a.to[e] + 1]) << n;
            ASSERT_EQ(a.length5[std::size_t(back - a.to.begin())], a.length5[e]);
        }
}

bool cross(Vec2f a, Vec2f b, Vec2f c, Vec2f d) {
    const auto side = [](Vec2f p, Vec2f q, Vec2f r) { return dot(perpendicular(q - p), r - p); };
    return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

TEST(HexagonLattice, NodesHaveSixNeighboursAndNoTwoEdgesCross) {
    for (const float moved : {0.f, 0.4f}) {
        const Lattice l = hexagon_lattice(moved, open_ground({17, 14}), jitter(4), {});
        ASSERT_NO_FATAL_FAILURE(expect_edges_go_both_ways_and_are_as_long_as_they_are(l));
        const Adjacency& a = *l.adjacency();
        for (int j = 1; j < 13; ++j)
            for (int i = 1; i < 16; ++i) {
                const std::uint32_t n = index(l.at(i, j));
                ASSERT_EQ(a.first[n + 1] - a.first[n], 6u);
                if (moved == 0) {
                    ASSERT_LE(*std::max_element(&a.length5[a.first[n]], &a.length5[a.first[n + 1]]), 6);
                }
            }
        std::vector<std::pair<Vec2f, Vec2f>> edges;
        for (std::uint32_t n = 0; n < l.node_count(); ++n)
            for (std::uint32_t e = a.first[n]; e < a.first[n + 1]; ++e)
                if (a.to[e] > n) edges.emplace_back(a.position_lattice[n], a.position_lattice[a.to[e]]);
        for (const auto& [p, q] : edges)
            for (const auto& [r, s] : edges) ASSERT_FALSE(cross(p, q, r, s)) << moved;
    }
}

TEST(MovedSquares, AreTheSquareLatticeWhereNothingIsMoved) {
    for (const Neighbourhood neighbourhood :
         {Neighbourhood::square4, Neighbourhood::square8, Neighbourhood::square16}) {
        Dice dice(9);
        const Extent e{23, 31};
        WeightedLattice still{Lattice(e, neighbourhood), {}, {}, true};
        // Knight's moves cost their ends alone where edges are listed.
        const int levels = neighbourhood == Neighbourhood::square16 ? 1 : 255;
        for (std::size_t n = 0; n < e.count(); ++n) still.weight.push_back(NodeWeight(dice.between(1, levels)));
        WeightedLattice moved = still;
        moved.lattice = moved_squares(neighbourhood, 0, open_ground(e), jitter(1), {});
        const Source source[] = {{NodeId{100}, 0, 0}};
        for (const Metric metric : test::kMetrics)
            test::expect_same_plan(tile_planner().plan({moved, source, metric}, {}),
                                   reference_planner().plan({still, source, metric}, {}), "");
    }
}

TEST(MovedSquares, NodesStayInTheirCellsAndEdgesOffWalls) {
    Grid<std::uint8_t> passable = open_ground({30, 20});
    for (int j = 0; j < 20; ++j) passable(15, j) = 0;
    const Lattice l = moved_squares(Neighbourhood::square16, 1, passable, jitter(2), {});
    ASSERT_NO_FATAL_FAILURE(expect_edges_go_both_ways_and_are_as_long_as_they_are(l));
    const Adjacency& a = *l.adjacency();
    for (std::uint32_t n = 0; n < l.node_count(); ++n) {
        ASSERT_EQ(l.nearest(a.position_lattice[n]), NodeId{n});
        for (std::uint32_t e = a.first[n]; e < a.first[n + 1]; ++e)
            ASSERT_EQ(l.column(NodeId{n}) < 15, l.column(NodeId{a.to[e]}) < 15);
    }
}

TEST(CubeLattice, WaysAcrossEvenGroundAreAsLongAsTheirDiagonals) {
    const Extent slice{7, 6};
    const int depth = 5;
    for (const auto neighbourhood : {CubeNeighbourhood::cube6, CubeNeighbourhood::cube26}) {
        WeightedLattice g{cube_lattice(slice, depth, neighbourhood), {}, {}, true};
        g.weight.assign(g.lattice.node_count(), 3);
        const Source source[] = {{NodeId{0}, 0, 0}};
        const Plan plan = tile_planner().plan({g, source, Metric::sum}, {});
        for (std::uint32_t n = 0; n < g.lattice.node_count(); ++n) {
            std::array<std::uint64_t, 3> way{n % 7, n / 7 % 6, n / 42};
            std::sort(way.begin(), way.end());
            const std::uint64_t length = neighbourhood == CubeNeighbourhood::cube6
                                             ? 5 * (way[0] + way[1] + way[2])
                                             : 9 * way[0] + 7 * (way[1] - way[0]) + 5 * (way[2] - way[1]);
            ASSERT_EQ(plan.label[n].sum, 6 * length) << n;
        }
    }
}

/// A lattice of some kind, of up to so many nodes on a side.
Lattice random_lattice(Dice& dice, int largest_side) {
    const Extent e{dice.between(1, largest_side), dice.between(1, largest_side)};
    Grid<std::uint8_t> passable = open_ground(e);
    if (dice.one_in(3))
        for (std::uint8_t& p : passable) p = !dice.one_in(7);
    const float moved = dice.one_in(3) ? 0 : dice.unit();
    constexpr Neighbourhood kSquares[] = {Neighbourhood::square4, Neighbourhood::square8, Neighbourhood::square16};
    switch (dice.below(4)) {
        case 0: return hexagon_lattice(moved, passable, jitter(dice.below(1000)), {});
        case 1: return moved_squares(kSquares[dice.below(3)], moved, passable, jitter(dice.below(1000)), {});
        case 2: return cube_lattice(e, dice.between(1, 6), CubeNeighbourhood::cube6);
        default: return cube_lattice(e, dice.between(1, 6), CubeNeighbourhood::cube26);
    }
}

TEST(ListedLattices, ThePlannersAgreeBitForBit) {
    for (std::uint32_t seed = 0; seed < 1000; ++seed) {
        Dice dice(seed);
        const test::RandomGraph g =
            test::random_graph_on(random_lattice(dice, seed % 25 == 0 && !test::kSanitized ? 90 : 12), seed);
        for (const Metric metric : test::kMetrics) {
            const PlanRequest request{g.graph, g.sources, metric, 500};
            const Plan expected = reference_planner().plan(request, {});
            Work two;
            two.threads = 2;
            ASSERT_NO_FATAL_FAILURE(
                test::expect_same_plan(bucket_planner().plan(request, {}), expected, std::to_string(seed)));
            ASSERT_NO_FATAL_FAILURE(
                test::expect_same_plan(tile_planner().plan(request, two), expected, std::to_string(seed)));
        }
    }
}

/// The same with one edge listed twice, both ways.
Adjacency with_an_edge_twice(const Adjacency& a, std::uint32_t edge) {
    Adjacency out{a.position_lattice, {0}, {}, {}};
    std::uint32_t from = 0;
    while (a.first[from + 1] <= edge) ++from;
    for (std::uint32_t u = 0; u + 1 < a.first.size(); ++u) {
        for (std::uint32_t e = a.first[u]; e < a.first[u + 1]; ++e)
            for (int times = (u == from && a.to[e] == a.to[edge]) || (u == a.to[edge] && a.to[e] == from) ? 2 : 1;
                 times > 0; --times) {
                out.to.push_back(a.to[e]);
                out.length5.push_back(a.length5[e]);
            }
        out.first.push_back(std::uint32_t(out.to.size()));
    }
    return out;
}

TEST(ListedLattices, OneWayEdgesAndListsInAnyOrderAreWalkedAsTheyAre) {
    for (std::uint32_t seed = 0; seed < 60; ++seed) {
        Dice dice(seed);
        const Lattice whole = hexagon_lattice(0, open_ground({9, 8}), jitter(1), {});
        Adjacency a = *whole.adjacency();
        const std::uint32_t edge = dice.below(std::uint32_t(a.to.size())), node = dice.below(72);
        switch (seed % 4) {
            case 0: a.to[edge] = (a.to[edge] + 1 + dice.below(70)) % 72; break;
            case 1: a.length5[edge] = 9; break;
            case 2: a = with_an_edge_twice(a, edge); break;
            default: std::reverse(a.to.begin() + a.first[node], a.to.begin() + a.first[node + 1]); break;
        }
        const Lattice lattice(whole.extent(), std::make_shared<Adjacency>(std::move(a)));
        const test::RandomGraph g = test::random_graph_on(lattice, seed);
        for (const Metric metric : test::kMetrics) {
            const PlanRequest request{g.graph, g.sources, metric, 500};
            ASSERT_NO_FATAL_FAILURE(test::expect_same_plan(
                tile_planner().plan(request, {}), reference_planner().plan(request, {}), std::to_string(seed)));
        }
    }
}

double bend(const Lattice& l, NodeId before, NodeId at, NodeId next) {
    const Vec2f in = normalized(l.position_lattice(at) - l.position_lattice(before));
    const Vec2f out = normalized(l.position_lattice(next) - l.position_lattice(at));
    return (1 - double(dot(in, out))) / 2;
}

Lattice scattered(Extent e) { return scattered_lattice(e, open_ground(e), jitter(3), {}); }

TEST(TurnPenalty, LabelsAreTheLeastOverNeighboursWithTheParentsThatTheyHave) {
    for (std::uint32_t seed = 0; seed < 60; ++seed) {
        const test::RandomGraph g = test::random_graph_on(scattered({14, 11}), seed);
        PlanRequest request{g.graph, g.sources, Metric::sum};
        request.turn_penalty = 256 * (1 + seed % 5);
        const Plan plan = tile_planner().plan(request, {});
        std::vector<double> least(g.graph.lattice.node_count(), 1e300);
        for (const Source& s : g.sources) least[index(s.node)] = std::min(least[index(s.node)], double(s.start));
        for (std::uint32_t u = 0; u < least.size(); ++u) {
            if (plan.label[u].sum == PathLabel::kUnreached) continue;
            for (int s = 0; s < g.graph.degree(NodeId{u}); ++s) {
                const NodeId v = g.graph.neighbour(NodeId{u}, s);
                double cost = g.graph.height(NodeId{u}, s) * g.graph.length5(NodeId{u}, s);
                if (cost == 0) continue;
                if (const NodeId before = plan.parent[u]; before != kNoNode)
                    cost += cost * request.turn_penalty / 256 * bend(g.graph.lattice, before, NodeId{u}, v);
                least[index(v)] = std::min(least[index(v)], double(plan.label[u].sum) + cost);
            }
        }
        for (std::uint32_t v = 0; v < least.size(); ++v)
            if (plan.label[v].sum != PathLabel::kUnreached) {
                // The planner rounds to whole numbers, and knows places to 1/1024.
                ASSERT_NEAR(double(plan.label[v].sum), least[v], 1 + least[v] * 0.004) << seed << ", node " << v;
            }
    }
}

TEST(TurnPenalty, MakesPathsBendLess) {
    const test::RandomGraph g = test::random_graph_on(scattered({60, 60}), 3);
    WeightedLattice even = g.graph;
    Dice dice(1);
    even.height_plane.clear();
    for (NodeWeight& w : even.weight) w = NodeWeight(dice.between(1, 60));
    const Source source[] = {{NodeId{1830}, 0, 0}};
    double before = 1e300;
    for (const std::uint32_t penalty : {0u, 256u, 1024u}) {
        PlanRequest request{even, source, Metric::sum};
        request.turn_penalty = penalty;
        const Plan plan = tile_planner().plan(request, {});
        double bends = 0;
        for (std::uint32_t v = 0; v < even.weight.size(); ++v)
            if (const NodeId u = plan.parent[v]; u != kNoNode && plan.parent[index(u)] != kNoNode)
                bends += bend(even.lattice, plan.parent[index(u)], u, NodeId{v});
        EXPECT_LT(bends, 0.8 * before) << penalty;
        before = bends;
    }
}

TEST(TurnPenalty, AllPlannersKnowIt) {
    for (std::uint32_t seed = 100; seed < 120; ++seed) {
        const test::RandomGraph g = test::random_graph_on(scattered({14, 11}), seed);
        for (const Metric metric : test::kMetrics) {
            PlanRequest request{g.graph, g.sources, metric};
            request.turn_penalty = 700;
            const Plan expected = reference_planner().plan(request, {});
            test::expect_same_plan(bucket_planner().plan(request, {}), expected, std::to_string(seed));
            test::expect_same_plan(tile_planner().plan(request, {}), expected, std::to_string(seed));
        }
    }
}

TEST(TurnPenalty, IsRefusedOnSquares) {
    WeightedLattice g{Lattice({5, 5}, Neighbourhood::square8), std::vector<NodeWeight>(25, 1), {}, true};
    const Source source[] = {{NodeId{0}, 0, 0}};
    PlanRequest request{g, source, Metric::sum};
    request.turn_penalty = 1;
    try {
        tile_planner().plan(request, {});
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_usage);
    }
}

}  // namespace
}  // namespace dstylize
