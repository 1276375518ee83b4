// The tile planner against the reference, bit for bit, with every instruction set that the machine has;
// and what its visits may number.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <string>

#include "graph/height_planes.h"
#include "graph/planner.h"
#include "graph/tile_planner.h"
#include "laws/random_graphs.h"
#include "support/sanitized.h"

namespace dstylize {
namespace {

using test::Dice;
using test::random_graph;
using test::RandomGraph;

/// Every instruction set in turn, best first; afterwards the best again.
template <class Body>
void with_every_instruction_set(Body body) {
    for (std::int64_t rest = hwy::SupportedTargets(); rest != 0; rest &= rest - 1) {
        hwy::SetSupportedTargetsForTest(rest & -rest);
        SCOPED_TRACE(hwy::TargetName(rest & -rest));
        body();
    }
    hwy::SetSupportedTargetsForTest(0);
}

/// Whether the tiles did it is checked, too: a planner that always asks another one agrees with it.
void expect_reference_answer(const RandomGraph& g, Metric metric, int threads = 1, bool by_tiles = true) {
    const PlanRequest request{g.graph, g.sources, metric};
    Work work;
    work.threads = threads;
    TileStats stats;
    const Plan expected = reference_planner().plan(request, {}), found = plan_by_tiles(request, work, stats);
    const std::string what = g.shape + ", " + std::string(metric_names()[std::size_t(metric)]);
    ASSERT_EQ(stats.tiles > 0, by_tiles) << what;
    ASSERT_NO_FATAL_FAILURE(test::expect_same_plan(found, expected, what));
}

std::uint32_t largest_height(const WeightedLattice& g) {
    std::uint32_t largest = 0;
    for (const auto& plane : g.height_plane)
        for (const std::uint16_t h : plane) largest = std::max<std::uint32_t>(largest, h);
    if (g.height_plane.empty())
        for (const NodeWeight w : g.weight) largest = std::max<std::uint32_t>(largest, 2u * w);
    return largest;
}

void expect_three_metrics(const RandomGraph& g, int threads = 1) {
    const bool fits = largest_height(g.graph) < 65535;
    const bool knights = g.graph.lattice.neighbourhood() == Neighbourhood::square16;
    const bool both_ways = g.graph.height_plane.empty() || g.graph.symmetric;
    ASSERT_NO_FATAL_FAILURE(expect_reference_answer(g, Metric::sum, threads));
    ASSERT_NO_FATAL_FAILURE(expect_reference_answer(g, Metric::max_sum, threads, fits));
    ASSERT_NO_FATAL_FAILURE(expect_reference_answer(g, Metric::lexicographic, threads, fits && !knights && both_ways));
}

RandomGraph weighted(Extent e, Neighbourhood neighbourhood, std::vector<NodeWeight> weight) {
    RandomGraph g;
    g.graph.lattice = Lattice(e, neighbourhood);
    g.graph.weight = std::move(weight);
    g.sources = {{NodeId{0}, 0, 0}};
    g.shape = std::to_string(e.x) + " x " + std::to_string(e.y);
    return g;
}

TEST(TilePlanner, AgreesWithTheReferenceOnTenThousandGraphs) {
    for (std::uint32_t seed = 0; seed < 10000; ++seed)
        ASSERT_NO_FATAL_FAILURE(expect_three_metrics(random_graph(seed, 16)));
}

TEST(TilePlanner, AgreesWithTheReferenceOnGraphsOfManyTiles) {
    for (std::uint32_t seed = 20000; seed < 20000 + test::fewer_if_sanitized(200); ++seed)
        ASSERT_NO_FATAL_FAILURE(expect_three_metrics(random_graph(seed, 300), 1 + int(seed % 3)));
}

TEST(TilePlanner, AgreesWithTheReferenceWithEveryInstructionSet) {
    with_every_instruction_set([] {
        for (std::uint32_t seed = 50000; seed < 50000 + test::fewer_if_sanitized(300); ++seed)
            ASSERT_NO_FATAL_FAILURE(expect_three_metrics(random_graph(seed, seed % 4 == 0 ? 140 : 24)));
    });
}

TEST(TilePlanner, AgreesWithTheReferenceWhereTilesEnd) {
    for (const Neighbourhood n : {Neighbourhood::square4, Neighbourhood::square8, Neighbourhood::square16})
        for (const int x : {1, 2, 59, 60, 61, 62, 63, 64, 65, 119, 120, 121, 123, 124, 125})
            for (const int y : {1, 60, 61, 62, 63, 124}) {
                Dice dice(std::uint32_t(x * 1000 + y));
                std::vector<NodeWeight> weight(std::size_t(x * y));
                for (NodeWeight& w : weight) w = NodeWeight(1 + dice.below(dice.one_in(2) ? 3 : 900));
                RandomGraph g = weighted({x, y}, n, std::move(weight));
                g.sources = {{NodeId{dice.below(std::uint32_t(x * y))}, dice.below(5000), 4},
                             {NodeId{dice.below(std::uint32_t(x * y))}, dice.below(5000), 7}};
                ASSERT_NO_FATAL_FAILURE(expect_three_metrics(g));
            }
}

TEST(TilePlanner, SpanningForestsAgreeWhereBlocksOfTilesMeet) {
    std::uint32_t seed = 0;
    for (const Extent e : {Extent{496, 496}, {497, 40}, {40, 1000}, {560, 530}})
        for (const std::uint32_t sources : {1u, 2u, 60u}) {
            Dice dice(++seed);
            const std::uint32_t heaviest = dice.one_in(2) ? 4 : 3000;
            std::vector<NodeWeight> weight(e.count());
            for (NodeWeight& w : weight) w = dice.one_in(8) ? 0 : NodeWeight(1 + dice.below(heaviest));
            RandomGraph g = weighted(e, Neighbourhood::square8, std::move(weight));
            g.sources.clear();
            while (g.sources.size() < sources) {
                const NodeId n{dice.below(std::uint32_t(e.count()))};
                if (g.graph.weight[index(n)] != 0) g.sources.push_back({n, dice.below(50), std::uint16_t(seed)});
            }
            ASSERT_NO_FATAL_FAILURE(expect_reference_answer(g, Metric::lexicographic, 1 + int(seed % 3)));
        }
}

/// Walls from side to side with a gap at alternate ends: one path through all of it.
RandomGraph serpentine(Extent e, NodeWeight floor, NodeWeight wall) {
    std::vector<NodeWeight> weight(e.count(), floor);
    for (int j = 1; j < e.y; j += 2)
        for (int i = 0; i < e.x; ++i)
            if (i != (j % 4 == 1 ? e.x - 1 : 0)) weight[std::size_t(j * e.x + i)] = wall;
    return weighted(e, Neighbourhood::square8, std::move(weight));
}

TEST(TilePlanner, FollowsAPathThatComesBackToATileManyTimes) {
    for (const NodeWeight floor : {1, 255, 1400, 9000, 20000})
        ASSERT_NO_FATAL_FAILURE(expect_reference_answer(serpentine({190, 130}, floor, kImpassable), Metric::sum));
    constexpr bool kByTiles = false;  // its sums need 33 bits
    ASSERT_NO_FATAL_FAILURE(
        expect_reference_answer(serpentine({190, 130}, 65535, kImpassable), Metric::sum, 1, kByTiles));
    ASSERT_NO_FATAL_FAILURE(expect_three_metrics(serpentine({190, 130}, 1, 255)));
}

TEST(TilePlanner, SeesStartLabelsAtTheEdgeOfA16BitWindow) {
    for (const std::uint64_t start : {1u, 65534u, 65535u, 65536u, 65535u - 14 * 255, 65536u - 14 * 255, 131070u})
        for (const NodeWeight w : {1, 3, 255}) {
            RandomGraph g = weighted({70, 5}, Neighbourhood::square8, std::vector<NodeWeight>(350, w));
            for (int j = 0; j < 5; ++j) g.graph.weight[std::size_t(70 * j + 25)] = kImpassable;  // so both last
            g.sources = {{NodeId{0}, 0, 1}, {NodeId{30}, start, 2}};
            ASSERT_NO_FATAL_FAILURE(expect_three_metrics(g));
        }
}

TEST(TilePlanner, TellsParentsApartWhoseSumsHaveTheSameLowHalf) {
    RandomGraph g = weighted({100, 1}, Neighbourhood::square8, std::vector<NodeWeight>(100, 1));
    g.sources = {{NodeId{50}, 65536, 0}, {NodeId{52}, 0, 1}};
    with_every_instruction_set([&] { ASSERT_NO_FATAL_FAILURE(expect_three_metrics(g)); });
}

TEST(TilePlanner, LeavesSumsThatDoNotFit32BitsToAnother) {
    RandomGraph g = weighted({90, 3}, Neighbourhood::square8, std::vector<NodeWeight>(270, 255));
    for (const std::uint64_t start : {0xffff0000ull - 300000, 0x100000000ull - 225000, 0xffff0000ull - 2, 0xffff0000ull,
                                      0xffffffffull, 0x100000000ull}) {
        g.sources = {{NodeId{0}, start, 1}};
        const Plan expected = reference_planner().plan({g.graph, g.sources, Metric::sum}, {});
        EXPECT_TRUE(tile_planner().plan({g.graph, g.sources, Metric::sum}, {}).label == expected.label) << start;
        EXPECT_TRUE(tile_planner().plan({g.graph, g.sources, Metric::sum}, {}).parent == expected.parent) << start;
    }
}

TEST(TilePlanner, KeepsMoreOwnersApartThanABytesWorth) {
    RandomGraph g = weighted({100, 40}, Neighbourhood::square8, std::vector<NodeWeight>(4000, 9));
    g.sources.clear();
    for (std::uint32_t k = 0; k < 300; ++k) g.sources.push_back({NodeId{k * 13}, k % 7, std::uint16_t(65534 - k)});
    ASSERT_NO_FATAL_FAILURE(expect_three_metrics(g));
}

TEST(TilePlanner, AnswersTheSameForAnyNumberOfThreads) {
    for (std::uint32_t seed = 60000; seed < 60000 + test::fewer_if_sanitized(20); ++seed) {
        const RandomGraph g = random_graph(seed, 700);
        for (const Metric metric : {Metric::sum, Metric::max_sum, Metric::lexicographic}) {
            const PlanRequest request{g.graph, g.sources, metric};
            Work one;
            one.threads = 1;
            const Plan expected = tile_planner().plan(request, one);
            for (const int threads : {2, 5}) {
                Work work;
                work.threads = threads;
                const Plan found = tile_planner().plan(request, work);
                ASSERT_TRUE(found.label == expected.label && found.parent == expected.parent) << g.shape;
                ASSERT_TRUE(found.owner == expected.owner) << g.shape;
            }
        }
    }
}

/// A plan after sources have come to those of `g`, in some of its tiles, with the labels of before.
void expect_reference_answer_again(const RandomGraph& g, std::uint32_t seed, Metric metric) {
    Dice dice(seed);
    Work work;
    work.threads = 1 + int(dice.below(2));
    const Plan before = tile_planner().plan({g.graph, g.sources, metric}, work);
    RandomGraph more = g;
    for (Source& s : more.sources)
        if (dice.one_in(2)) s.start -= dice.below(std::uint32_t(std::min<std::uint64_t>(s.start, 100)) + 1);
    const std::uint32_t nodes = std::uint32_t(g.graph.lattice.node_count());
    for (std::uint32_t k = dice.below(5); k > 0; --k)
        if (const NodeId n{dice.below(nodes)}; g.graph.passable(n)) more.sources.push_back({n, dice.below(300), 9});
    if (dice.one_in(8)) more.sources.erase(more.sources.begin());  // of no use then
    if (more.sources.empty()) return;
    const PlanRequest request{more.graph, more.sources, metric, 5000, &before, g.sources};
    const Plan expected = reference_planner().plan(request, {}), found = tile_planner().plan(request, work);
    const std::string what = g.shape + ", " + std::string(metric_names()[std::size_t(metric)]);
    ASSERT_NO_FATAL_FAILURE(test::expect_same_plan(found, expected, what));
}

TEST(TilePlanner, UsesLabelsAgainWhenSourcesHaveCome) {
    for (std::uint32_t seed = 70000; seed < 70000 + test::fewer_if_sanitized(600); ++seed)
        for (const Metric metric : test::kMetrics)
            ASSERT_NO_FATAL_FAILURE(
                expect_reference_answer_again(random_graph(seed, seed % 30 == 0 ? 200 : 20), seed, metric));
}

TEST(TilePlanner, SearchesOnlyWhatFallsWhenASourceHasCome) {
    const RandomGraph g = weighted({620, 620}, Neighbourhood::square8, std::vector<NodeWeight>(620 * 620, 9));
    TileStats stats;
    const Plan before = plan_by_tiles({g.graph, g.sources, Metric::sum}, {}, stats);
    const std::vector<Source> more{g.sources[0], {NodeId{619 * 620 + 619}, before.label[619 * 620 + 519].sum, 1}};
    const PlanRequest request{g.graph, more, Metric::sum, 5000, &before, g.sources};
    TileStats again;
    const Plan found = plan_by_tiles(request, {}, again);
    EXPECT_TRUE(found.label == reference_planner().plan(request, {}).label);
    EXPECT_GT(again.visits, 0u);
    EXPECT_LT(10 * again.visits, stats.visits);
}

/// Work is counted, as time is not tested: visits and rows for 8 neighbours and noise, the costliest map, from 0.25 to
/// 24 megapixels.
TEST(TilePlanner, VisitsATileAFewTimes) {
    struct Most {
        Metric metric;
        double visits_of_a_tile, relaxations_of_a_node;
    };
    for (const int side : {500, 1000, test::kSanitized ? 1500 : 4900}) {
        Dice dice(1);
        std::vector<NodeWeight> weight(std::size_t(side) * std::size_t(side));
        for (NodeWeight& w : weight) w = NodeWeight(1 + dice.below(255));
        const double nodes = double(weight.size());
        const RandomGraph g = weighted({side, side}, Neighbourhood::square8, std::move(weight));
        for (const Most most : {Most{Metric::sum, 3.5, 40}, Most{Metric::max_sum, 10, 100}}) {
            SCOPED_TRACE(g.shape + ", " + std::string(metric_names()[std::size_t(most.metric)]));
            Work work;
            work.threads = 1;
            TileStats stats;
            plan_by_tiles({g.graph, g.sources, most.metric}, work, stats);
            EXPECT_LE(double(stats.visits) / double(stats.tiles), most.visits_of_a_tile);
            EXPECT_LE(64.0 * double(stats.rows_relaxed) / nodes, most.relaxations_of_a_node);
        }
    }
}

/// A window's labels span three times what 16 bits hold.
TEST(TilePlanner, VisitsATileAboutOnceWhereLabelsRiseSteeply) {
    const RandomGraph g = weighted({1000, 1000}, Neighbourhood::square8, std::vector<NodeWeight>(1000000, 255));
    Work work;
    work.threads = 1;
    TileStats stats;
    plan_by_tiles({g.graph, g.sources, Metric::sum}, work, stats);
    EXPECT_LE(double(stats.visits) / double(stats.tiles), 1.2);
}

}  // namespace
}  // namespace dstylize
