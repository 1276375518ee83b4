#include "graph/height_planes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "graph/scattered_lattice.h"
#include "laws/random_graphs.h"

namespace dstylize {
namespace {

using test::Dice;

WeightedLattice random_weights(Dice& dice, Extent e, Neighbourhood neighbourhood, int levels,
                               std::uint32_t one_wall_in) {
    WeightedLattice g;
    g.lattice = Lattice(e, neighbourhood);
    for (std::size_t n = 0; n < e.count(); ++n)
        g.weight.push_back(dice.one_in(one_wall_in) ? kImpassable : NodeWeight(dice.between(1, levels)));
    return g;
}

/// Calls visit(node, step, height by weights alone, height by planes) for every node and step.
template <class Visit>
void compare_heights(const WeightedLattice& planes, Visit visit) {
    WeightedLattice weights = planes;
    weights.height_plane.clear();
    for (std::uint32_t n = 0; n < planes.lattice.node_count(); ++n)
        for (int s = 0; s < int(planes.lattice.steps().size()); ++s)
            visit(NodeId{n}, s, weights.height(NodeId{n}, s), planes.height(NodeId{n}, s));
}

double sin2_between(Step s, Vec2f flow) {
    const double cross = double(s.dx) * flow.y - double(s.dy) * flow.x;
    return cross * cross / (double(s.dx * s.dx + s.dy * s.dy) * (double(flow.x) * flow.x + double(flow.y) * flow.y));
}

constexpr Neighbourhood kNeighbourhoods[] = {Neighbourhood::square4, Neighbourhood::square8, Neighbourhood::square16};

TEST(HeightPlanes, WithoutDirectionAreTheHeightsOfTheWeights) {
    for (const Neighbourhood neighbourhood : kNeighbourhoods) {
        Dice dice(1);
        WeightedLattice g = random_weights(dice, {37, 23}, neighbourhood, 32767, 8);
        build_height_planes(g, {}, {});
        EXPECT_TRUE(g.symmetric);
        EXPECT_EQ(g.height_plane.size(), g.lattice.steps().size() / 2);
        compare_heights(g, [&](NodeId n, int s, std::uint32_t weights, std::uint32_t planes) {
            ASSERT_EQ(planes, weights) << "node " << index(n) << ", step " << s;
        });
    }
}

TEST(HeightPlanes, FollowTheFormulaOfTheFlow) {
    Dice dice(2);
    for (const float angle : {0.f, 0.3f, 0.7854f, 1.5708f, 2.5f, 4.f}) {
        for (const float coherence : {0.25f, 1.f}) {
            WeightedLattice g = random_weights(dice, {19, 17}, Neighbourhood::square16, 255, 10);
            const Vec2f flow = Vec2f{std::cos(angle), std::sin(angle)} * coherence;
            DirectionalCost cost{Grid<Vec2f>(g.lattice.extent(), flow), 2.5f, {}};
            build_height_planes(g, cost, {});
            compare_heights(g, [&](NodeId, int s, std::uint32_t weights, std::uint32_t planes) {
                const Step step = g.lattice.steps()[std::size_t(s)];
                const double expected = weights * (1 + 2.5 * coherence * sin2_between(step, flow));
                ASSERT_NEAR(planes, expected, 0.5 + expected * 0.004) << "step " << s << ", angle " << angle;
            });
        }
    }
}

TEST(HeightPlanes, FollowTheFormulaOnIrregularLatticesToo) {
    const Extent e{25, 19};
    WeightedLattice g;
    g.lattice = scattered_lattice(e, Grid<std::uint8_t>(e, 1), Noise(1, Purpose::jitter), {});
    Dice dice(7);
    for (std::size_t n = 0; n < e.count(); ++n)
        g.weight.push_back(dice.one_in(9) ? kImpassable : NodeWeight(dice.between(1, 255)));
    const Vec2f flow{0.3f, 0.6f}, pull{0.4f, -0.7f};
    build_height_planes(g, {Grid<Vec2f>(e, flow), 2.5f, pull_factors(g.lattice, pull)}, {});
    const Adjacency& a = *g.lattice.adjacency();
    for (std::uint32_t u = 0; u < e.count(); ++u)
        for (std::uint32_t edge = a.first[u]; edge < a.first[u + 1]; ++edge) {
            const Vec2f way = a.position_lattice[a.to[edge]] - a.position_lattice[u];
            const double cross = double(way.x) * flow.y - double(way.y) * flow.x;
            const double across = 1 + 2.5 * cross * cross / double(dot(way, way) * length(flow));
            const bool exists = g.weight[u] != kImpassable && g.weight[a.to[edge]] != kImpassable;
            const double expected =
                exists ? (g.weight[u] + g.weight[a.to[edge]]) * across * double(pull_factor(way, pull)) : 0;
            ASSERT_NEAR(g.height_plane[0][edge], expected, 0.5 + expected * 0.006) << u;
        }
}

TEST(HeightPlanes, DoNotCareForTheSignOfTheFlow) {
    Dice dice(3);
    WeightedLattice g = random_weights(dice, {31, 31}, Neighbourhood::square16, 255, 10), opposite = g;
    DirectionalCost cost{Grid<Vec2f>(g.lattice.extent()), 3, {}};
    for (Vec2f& f : cost.flow) f = {dice.unit() - 0.5f, dice.unit() - 0.5f};
    build_height_planes(g, cost, {});
    for (Vec2f& f : cost.flow) f = f * -1;
    build_height_planes(opposite, cost, {});
    EXPECT_EQ(g.height_plane, opposite.height_plane);
}

TEST(HeightPlanes, DownwardBiasFavoursFalling) {
    for (const Neighbourhood neighbourhood : kNeighbourhoods) {
        Dice dice(4);
        WeightedLattice g = random_weights(dice, {21, 13}, neighbourhood, 255, 9);
        DirectionalCost cost;
        cost.step_factor = downward_bias(g.lattice, 3);
        build_height_planes(g, cost, {});
        EXPECT_FALSE(g.symmetric);
        EXPECT_EQ(g.height_plane.size(), g.lattice.steps().size());
        compare_heights(g, [&](NodeId, int s, std::uint32_t weights, std::uint32_t planes) {
            const Step step = g.lattice.steps()[std::size_t(s)];
            const double uy = step.dy / std::hypot(double(step.dx), double(step.dy));
            ASSERT_NEAR(planes, weights * (1 + 3 * (1 - uy) / 2), 0.5 + weights * 0.002) << "step " << s;
            if (step.dx == 0) {
                ASSERT_EQ(planes, step.dy > 0 ? weights : 4 * weights);
            }
        });
    }
}

TEST(HeightPlanes, SaturateAndNeverLoseAnEdge) {
    Dice dice(5);
    WeightedLattice g = random_weights(dice, {25, 25}, Neighbourhood::square16, 65535, 7);
    DirectionalCost cost{Grid<Vec2f>(g.lattice.extent(), {0, 1}), 1000, std::vector<float>(16, 1.f)};
    cost.step_factor[6] = 1e-6f;
    cost.step_factor[3] = 1e6f;
    build_height_planes(g, cost, {});
    compare_heights(g, [&](NodeId, int s, std::uint32_t weights, std::uint32_t planes) {
        ASSERT_EQ(planes != 0, weights != 0) << "step " << s;
        if (s == 3 && weights > 2000) {
            ASSERT_EQ(planes, 65535u);
        }
    });
}

TEST(HeightPlanes, DoNotDependOnThreads) {
    Dice dice(6);
    WeightedLattice one = random_weights(dice, {200, 150}, Neighbourhood::square16, 255, 10), eight = one;
    DirectionalCost cost{Grid<Vec2f>(one.lattice.extent()), 2, downward_bias(one.lattice, 1)};
    for (Vec2f& f : cost.flow) f = {dice.unit() - 0.5f, dice.unit() - 0.5f};
    Work work;
    work.threads = 1;
    build_height_planes(one, cost, work);
    work.threads = 8;
    build_height_planes(eight, cost, work);
    EXPECT_EQ(one.height_plane, eight.height_plane);
}

TEST(HeightPlanes, AreTheSameInEveryBuild) {
    Dice dice(7);
    WeightedLattice g = random_weights(dice, {101, 67}, Neighbourhood::square16, 255, 12);
    DirectionalCost cost{Grid<Vec2f>(g.lattice.extent()), 1.7f, downward_bias(g.lattice, 0.9f)};
    for (Vec2f& f : cost.flow) f = {dice.unit() - 0.5f, dice.unit() - 0.5f};
    build_height_planes(g, cost, {});
    std::uint64_t hash = 0xcbf29ce484222325;  // FNV-1a
    for (const auto& plane : g.height_plane)
        for (const std::uint16_t h : plane) hash = (hash ^ h) * 0x100000001b3;
    EXPECT_EQ(hash, 0xe4b24a3ee68e56c2u);
}

TEST(WeightedLattice, HeightsAreTheSameBothWaysAndNothingLeavesTheLattice) {
    for (std::uint32_t seed = 0; seed < 500; ++seed) {
        const test::RandomGraph r = test::random_graph(seed, 12);
        const WeightedLattice& g = r.graph;
        for (std::uint32_t n = 0; n < g.lattice.node_count(); ++n)
            for (int s = 0; s < int(g.lattice.steps().size()); ++s) {
                const NodeId to = g.neighbour(NodeId{n}, s);
                if (to == kNoNode) {
                    ASSERT_EQ(g.height(NodeId{n}, s), 0u) << r.shape;
                } else {
                    ASSERT_EQ(g.neighbour(to, s ^ 1), NodeId{n}) << r.shape;
                    if (g.symmetric) {
                        ASSERT_EQ(g.height(to, s ^ 1), g.height(NodeId{n}, s)) << r.shape;
                    }
                }
            }
    }
}

TEST(WeightedLattice, KnightsMoveCostsTheFourNodesItTouches) {
    WeightedLattice g;
    g.lattice = Lattice({3, 2}, Neighbourhood::square16);
    g.weight = {1, 10, 100, 1000, 7, 20};
    const auto height = [&](int from, int to) {
        for (int s = 0; s < 16; ++s)
            if (g.neighbour(NodeId{std::uint32_t(from)}, s) == NodeId{std::uint32_t(to)})
                return int(g.height(NodeId{std::uint32_t(from)}, s));
        return -1;
    };
    EXPECT_EQ(height(0, 5), (1 + 10 + 7 + 20) / 2);
    EXPECT_EQ(height(2, 3), (100 + 10 + 7 + 1000) / 2);
    EXPECT_EQ(height(0, 4), 1 + 7);
    g.weight[4] = kImpassable;
    EXPECT_EQ(height(0, 5), 0) << "it would pass between an impassable node";
    EXPECT_EQ(height(2, 3), 0);
    EXPECT_EQ(height(1, 5), 30);
}

}  // namespace
}  // namespace dstylize
