#include "graph/graph_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "laws/random_graphs.h"

namespace dstylize {
namespace {

using test::Dice;

/// The rule word by word: look at every node that may still be expanded, take the cheapest.
std::vector<NodeId> stipples_by_looking(const GraphDistanceRequest& r) {
    const Extent e = r.expense.extent();
    constexpr std::int64_t kFar = std::numeric_limits<std::int64_t>::max();
    const std::int64_t threshold = std::lround(r.threshold * 2 * 1023.f);
    std::vector<std::int64_t> distance(e.count(), kFar), cost(e.count());
    std::vector<bool> open(e.count());
    for (std::size_t n = 0; n < e.count(); ++n) {
        open[n] = r.mask.empty() || r.mask[n] != 0;
        cost[n] = std::max<std::int64_t>(1, std::lround(r.expense[n] * 1023.f));
    }
    for (const NodeId s : r.starts) distance[index(s)] = 0;
    std::vector<NodeId> stipples;
    for (;;) {
        std::size_t u = e.count();
        for (std::size_t n = 0; n < e.count(); ++n)
            if (open[n] && distance[n] != kFar && (u == e.count() || distance[n] < distance[u])) u = n;
        if (u == e.count()) {
            u = std::size_t(std::find(open.begin(), open.end(), true) - open.begin());
            if (u == e.count()) return stipples;
            distance[u] = 0;
        }
        open[u] = false;
        if (distance[u] > threshold) {
            stipples.push_back(NodeId{std::uint32_t(u)});
            distance[u] = 0;
        }
        const int i = int(u) % e.x, j = int(u) / e.x;
        constexpr Offset kWays[4] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
        for (const Offset o : kWays) {
            if (!e.contains(i + o.dx, j + o.dy)) continue;
            const std::size_t v = std::size_t(j + o.dy) * std::size_t(e.x) + std::size_t(i + o.dx);
            distance[v] = std::min(distance[v], distance[u] + cost[u] + cost[v]);
        }
    }
}

Grid<float> random_expense(Dice& dice, Extent e) {
    Grid<float> expense(e, dice.unit());
    const std::uint32_t kind = dice.below(3);
    if (kind == 1)
        for (float& x : expense) x = dice.unit();
    if (kind == 2)
        for (float& x : expense) x = float(dice.below(3)) / 4;
    return expense;
}

const Grid<std::uint8_t> kNoMask;

TEST(GraphDistance, FollowsItsRuleNodeByNode) {
    std::size_t placed = 0;
    for (std::uint32_t seed = 0; seed < 1500; ++seed) {
        Dice dice(seed);
        const Extent e{dice.between(1, 17), dice.one_in(4) ? 1 : dice.between(1, 17)};
        const Grid<float> expense = random_expense(dice, e);
        Grid<std::uint8_t> mask(e, 1);
        if (dice.one_in(2))
            for (std::uint8_t& m : mask) m = dice.one_in(3) ? 0 : 255;
        std::vector<NodeId> starts;
        for (std::uint32_t k = dice.below(4); k > 0; --k)
            starts.push_back(NodeId{dice.below(std::uint32_t(e.count()))});
        const GraphDistanceRequest request{expense, 0.1f + 4 * dice.unit() * dice.unit(), starts, mask};
        const std::vector<NodeId> stipples = graph_distance_stipples(request, {});
        ASSERT_EQ(stipples, stipples_by_looking(request)) << "seed " << seed;
        placed += stipples.size();
    }
    EXPECT_GT(placed, 10000u);
}

TEST(GraphDistance, CellsMayBeThousandsOfDearStepsWide) {
    const Grid<float> expense({6000, 1}, 1);
    const NodeId start[] = {NodeId{0}};
    EXPECT_EQ(graph_distance_stipples({expense, 2500, start, kNoMask}, {}),
              (std::vector<NodeId>{NodeId{2501}, NodeId{5002}}));
}

TEST(GraphDistance, SpacingIsTheThresholdOverTheExpense) {
    const NodeId start[] = {NodeId{0}};
    std::size_t before = 0;
    for (const float level : {0.125f, 0.25f, 0.5f, 1.f}) {
        const Grid<float> expense({256, 256}, level);
        const std::size_t count = graph_distance_stipples({expense, 4, start, kNoMask}, {}).size();
        // In the city-block metric a stipple at distance d from the next ones takes d^2 / 2 to d^2 nodes.
        const double spacing = 4 / level, nodes_each = 65536.0 / double(count);
        EXPECT_GT(nodes_each, spacing * spacing / 2.5);
        EXPECT_LT(nodes_each, spacing * spacing * 1.6);
        EXPECT_GT(count, before);
        before = count;
    }
}

TEST(GraphDistance, DenserWhereThePictureIsImportant) {
    Grid<float> expense({200, 100}, 0.2f);
    for (int j = 0; j < 100; ++j)
        for (int i = 100; i < 200; ++i) expense(i, j) = 0.8f;
    const NodeId start[] = {NodeId{100}};
    std::size_t left = 0, right = 0;
    for (const NodeId n : graph_distance_stipples({expense, 3, start, kNoMask}, {}))
        ++(index(n) % 200 < 100 ? left : right);
    EXPECT_GT(left, 10u);
    EXPECT_GT(right, 8 * left) << "four times the expense is a quarter of the spacing, so sixteen times the stipples";
}

TEST(GraphDistance, StaysInTheMaskAndReachesEveryPartOfIt) {
    const Extent e{120, 40};
    Grid<float> expense(e, 0.5f);
    Grid<std::uint8_t> mask(e, 0);
    for (int j = 5; j < 35; ++j)
        for (int i = 0; i < 120; ++i) mask(i, j) = i % 40 < 30;  // three islands
    const NodeId start[] = {NodeId{10 * 120 + 5}};
    const std::vector<NodeId> stipples = graph_distance_stipples({expense, 3, start, mask}, {});
    for (const int threads : {1, 2, 5}) {
        Work work;
        work.threads = threads;
        EXPECT_EQ(graph_distance_stipples({expense, 3, start, mask}, work), stipples) << threads << " threads";
    }
    std::set<NodeId> distinct(stipples.begin(), stipples.end());
    EXPECT_EQ(distinct.size(), stipples.size()) << "a node became a stipple twice";
    EXPECT_FALSE(distinct.contains(start[0]));
    std::size_t on_island[3] = {};
    for (const NodeId n : stipples) {
        ASSERT_NE(mask[index(n)], 0);
        ++on_island[index(n) % 120 / 40];
    }
    for (const std::size_t count : on_island) EXPECT_GT(count, 10u);
}

TEST(GraphDistance, IsDeterministicAndSurvivesEdgeCases) {
    Dice dice(1);
    const Grid<float> expense = random_expense(dice, {90, 70});
    const NodeId start[] = {NodeId{3000}};
    const GraphDistanceRequest request{expense, 0.7f, start, kNoMask};
    EXPECT_EQ(graph_distance_stipples(request, {}), graph_distance_stipples(request, {}));

    const Grid<float> one({1, 1}, 1), none_at_all({8, 8}, 0), not_a_number({8, 8}, std::nanf(""));
    const Grid<std::uint8_t> all_masked({8, 8}, 0);
    EXPECT_TRUE(graph_distance_stipples({one, 1, {}, kNoMask}, {}).empty());
    EXPECT_TRUE(graph_distance_stipples({none_at_all, 1, {}, kNoMask}, {}).empty());
    EXPECT_TRUE(graph_distance_stipples({not_a_number, 1, {}, kNoMask}, {}).empty());
    EXPECT_TRUE(graph_distance_stipples({none_at_all, 1e-3f, {}, all_masked}, {}).empty());
    EXPECT_EQ(graph_distance_stipples({none_at_all, 1e-3f, {}, kNoMask}, {}).size(), 32u - 1u)
        << "with a threshold of one least step the stipples are a chequerboard without its first node";
}

TEST(GraphDistance, StopsWhenAsked) {
    const Grid<float> expense({8, 8}, 0.5f);
    std::stop_source stop;
    stop.request_stop();
    Work work;
    work.stop = stop.get_token();
    EXPECT_THROW(graph_distance_stipples({expense, 1, {}, kNoMask}, work), Error);
}

}  // namespace
}  // namespace dstylize
