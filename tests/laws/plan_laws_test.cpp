// What every plan promises whatever the metric: parents, owners, sources, unreached parts, errors.
// The laws run over every planner.
#include <gtest/gtest.h>

#include <map>
#include <tuple>

#include "graph/bucket_planner.h"
#include "graph/planner.h"
#include "graph/tile_planner.h"
#include "laws/random_graphs.h"
#include "support/sanitized.h"

namespace dstylize {
namespace {

using test::kMetrics;
using test::random_graph;
using test::RandomGraph;

constexpr Metric kPathMetrics[] = {Metric::sum, Metric::max_sum, Metric::blend};
constexpr std::uint32_t kFactor = 5000;

class EveryPlanner : public ::testing::TestWithParam<const Planner* (*)()> {
  protected:
    Plan plan(const RandomGraph& g, Metric metric) const {
        return GetParam()()->plan({g.graph, g.sources, metric, kFactor}, {});
    }
};

const Planner* the_reference() { return &reference_planner(); }
const Planner* the_buckets() { return &bucket_planner(); }
const Planner* the_tiles() { return &tile_planner(); }
INSTANTIATE_TEST_SUITE_P(Reference, EveryPlanner, ::testing::Values(&the_reference));
INSTANTIATE_TEST_SUITE_P(Bucket, EveryPlanner, ::testing::Values(&the_buckets));
INSTANTIATE_TEST_SUITE_P(Tiles, EveryPlanner, ::testing::Values(&the_tiles));

/// How a metric compares labels.
std::pair<std::uint64_t, std::uint64_t> compared(Metric metric, PathLabel l) {
    if (metric == Metric::max_sum) return {l.highest, l.sum};
    if (metric == Metric::blend) return {std::uint64_t(kFactor) * l.highest + l.sum, l.highest};
    return {l.sum, 0};
}

WeightedLattice row_of(std::vector<NodeWeight> weight) {
    WeightedLattice g;
    g.lattice = Lattice({int(weight.size()), 1}, Neighbourhood::square8);
    g.weight = std::move(weight);
    return g;
}

constexpr std::uint32_t kRandomGraphs = test::fewer_if_sanitized(1000);

TEST_P(EveryPlanner, ParentIsTheSmallestNeighbourThatGivesTheLabel) {
    for (std::uint32_t seed = 0; seed < kRandomGraphs; ++seed) {
        const RandomGraph g = random_graph(seed, 14);
        std::map<NodeId, std::uint64_t> start;
        for (const Source& s : g.sources) {
            const auto [at, fresh] = start.emplace(s.node, s.start);
            if (!fresh) at->second = std::min(at->second, s.start);
        }
        for (const Metric metric : kPathMetrics) {
            const Plan p = plan(g, metric);
            std::vector<NodeId> expected(p.parent.size(), kNoNode);
            for (std::uint32_t u = 0; u < p.parent.size(); ++u) {
                if (p.label[u].sum == PathLabel::kUnreached) continue;
                for (int s = 0; s < int(g.graph.lattice.steps().size()); ++s) {
                    const std::uint32_t h = g.graph.height(NodeId{u}, s);
                    if (h == 0) continue;
                    const std::uint32_t v = index(g.graph.neighbour(NodeId{u}, s));
                    const PathLabel reached{metric == Metric::sum ? 0 : std::max(p.label[u].highest, h),
                                            p.label[u].sum + std::uint64_t(h) * g.graph.lattice.steps()[s].length5};
                    if (reached != p.label[v]) continue;
                    const auto key = [&](std::uint32_t n) { return std::pair(compared(metric, p.label[n]), n); };
                    if (expected[v] == kNoNode || key(u) < key(index(expected[v]))) expected[v] = NodeId{u};
                }
            }
            // A source that is reached no cheaper from elsewhere keeps its own label and has no parent.
            for (const auto& [node, label] : start)
                if (p.label[index(node)] == PathLabel{0, label}) expected[index(node)] = kNoNode;
            ASSERT_TRUE(p.parent == ParentColumn(expected)) << g.shape << ", " << metric_names()[std::size_t(metric)];
        }
    }
}

TEST_P(EveryPlanner, OwnerIsTheOwnerOfTheSourceAtTheEndOfTheParents) {
    for (std::uint32_t seed = 0; seed < kRandomGraphs; ++seed) {
        const RandomGraph g = random_graph(seed, 14);
        std::map<NodeId, std::pair<std::uint64_t, std::uint16_t>> own;
        for (const Source& s : g.sources) {
            const auto [at, fresh] = own.emplace(s.node, std::pair(s.start, s.owner));
            if (!fresh) at->second = std::min(at->second, std::pair(s.start, s.owner));
        }
        for (const Metric metric : kMetrics) {
            const Plan p = plan(g, metric);
            for (std::uint32_t v = 0; v < p.owner.size(); ++v) {
                if (p.label[v].sum == PathLabel::kUnreached) continue;
                std::size_t steps = 0;
                NodeId n{v};
                for (; p.parent[index(n)] != kNoNode; n = p.parent[index(n)])
                    ASSERT_LT(++steps, p.owner.size()) << g.shape;
                ASSERT_TRUE(own.contains(n)) << g.shape;
                ASSERT_EQ(p.owner[v], own.at(n).second) << g.shape << ", node " << v;
            }
        }
    }
}

TEST_P(EveryPlanner, ExactlyTheUnreachableNodesHaveNoLabelParentOrOwner) {
    std::uint32_t unreachable = 0;
    for (std::uint32_t seed = 0; seed < kRandomGraphs; ++seed) {
        const RandomGraph g = random_graph(seed, 14);
        const std::vector<bool> reached = test::reachable(g);
        for (const Metric metric : kMetrics) {
            const Plan p = plan(g, metric);
            for (std::size_t v = 0; v < reached.size(); ++v) {
                ASSERT_EQ(p.label[v].sum != PathLabel::kUnreached, reached[v]) << g.shape << ", node " << v;
                ASSERT_EQ(p.owner[v] != Plan::kNoOwner, reached[v]) << g.shape << ", node " << v;
                if (reached[v]) continue;
                ++unreachable;
                ASSERT_EQ(p.label[v], PathLabel{});
                ASSERT_EQ(p.parent[v], kNoNode);
            }
        }
    }
    EXPECT_GT(unreachable, kRandomGraphs) << "the graphs hold too few unreachable nodes to mean anything";
}

TEST_P(EveryPlanner, LabelsAddUpAlongTheParents) {
    for (std::uint32_t seed = 0; seed < test::fewer_if_sanitized(300); ++seed) {
        const RandomGraph g = random_graph(seed, 14);
        for (const Metric metric : kMetrics) {
            const Plan p = plan(g, metric);
            for (std::uint32_t u = 0; u < p.parent.size(); ++u)
                for (int s = 0; s < int(g.graph.lattice.steps().size()); ++s) {
                    const NodeId v = g.graph.neighbour(NodeId{u}, s);
                    if (v == kNoNode || p.parent[index(v)] != NodeId{u}) continue;
                    const std::uint32_t h = g.graph.height(NodeId{u}, s);
                    ASSERT_GT(h, 0u) << g.shape;
                    ASSERT_EQ(p.label[index(v)].sum,
                              p.label[u].sum + std::uint64_t(h) * g.graph.lattice.steps()[s].length5);
                    const bool has_highest = metric == Metric::max_sum || metric == Metric::blend;
                    ASSERT_EQ(p.label[index(v)].highest, has_highest ? std::max(p.label[u].highest, h) : 0);
                }
        }
    }
}

TEST_P(EveryPlanner, SourceReachedStrictlyCheaperBelongsToTheOther) {
    const WeightedLattice g = row_of({1, 1, 1});  // every edge has height 2 and costs 10
    const Source cheaper[] = {{NodeId{0}, 0, 1}, {NodeId{2}, 21, 2}}, equal[] = {{NodeId{0}, 0, 1}, {NodeId{2}, 20, 2}};
    const Plan taken = GetParam()()->plan({g, cheaper, Metric::sum}, {});
    EXPECT_EQ(taken.label[2], (PathLabel{0, 20}));
    EXPECT_EQ(taken.parent[2], NodeId{1});
    EXPECT_EQ(taken.owner[2], 1);
    const Plan kept = GetParam()()->plan({g, equal, Metric::sum}, {});
    EXPECT_EQ(kept.parent[2], kNoNode);
    EXPECT_EQ(kept.owner[2], 2);
    for (const Metric metric : {Metric::max_sum, Metric::lexicographic}) {
        const Plan p = GetParam()()->plan({g, cheaper, metric}, {});
        EXPECT_EQ(p.parent[2], kNoNode) << "no edge is as low as a source's own label";
        EXPECT_EQ(p.owner[2], 2);
    }
}

TEST_P(EveryPlanner, SourceNamedTwiceKeepsItsSmallestStartThenOwner) {
    const WeightedLattice g = row_of({1, 1});
    const Source sources[] = {{NodeId{0}, 7, 1}, {NodeId{0}, 5, 9}, {NodeId{0}, 5, 3}, {NodeId{0}, 6, 0}};
    for (const Metric metric : kMetrics) {
        const Plan p = GetParam()()->plan({g, sources, metric}, {});
        EXPECT_EQ(p.label[0].sum, 5u);
        EXPECT_EQ(p.owner[0], 3);
        EXPECT_EQ(p.owner[1], 3);
    }
}

TEST_P(EveryPlanner, PathsMayDependOnTheDirectionInWhichTheyAreWalked) {
    WeightedLattice g = row_of({1, 1, 1});
    g.symmetric = false;
    g.height_plane.assign(8, std::vector<std::uint16_t>(3, 0));
    g.height_plane[0] = {1, 1, 0};    // towards +x
    g.height_plane[1] = {0, 100, 0};  // towards -x, and no edge from 2 to 1
    const Source middle[] = {{NodeId{1}, 0, 0}}, last[] = {{NodeId{2}, 0, 0}};
    for (const Metric metric : kMetrics) {
        const Plan p = GetParam()()->plan({g, middle, metric}, {});
        EXPECT_EQ(p.label[0].sum, 500u);
        EXPECT_EQ(p.label[2].sum, 5u);
        EXPECT_EQ(GetParam()()->plan({g, last, metric}, {}).label[1], PathLabel{});
    }
}

TEST_P(EveryPlanner, RefusesToStartFromNowhere) {
    const WeightedLattice g = row_of({1, kImpassable});
    const auto code = [&](std::vector<Source> sources) {
        try {
            GetParam()()->plan({g, sources, Metric::sum}, {});
        } catch (const Error& e) {
            return e.code();
        }
        return ErrorCode::failed;
    };
    EXPECT_EQ(code({}), ErrorCode::bad_usage);
    EXPECT_EQ(code({{NodeId{0}, 0, 0}, {NodeId{1}, 0, 0}}), ErrorCode::bad_usage);
}

TEST_P(EveryPlanner, StopsWhenAsked) {
    const WeightedLattice g = row_of({1, 1});
    const Source source[] = {{NodeId{0}, 0, 0}};
    std::stop_source stop;
    stop.request_stop();
    Work work;
    work.stop = stop.get_token();
    for (const Metric metric : kMetrics) EXPECT_THROW(GetParam()()->plan({g, source, metric}, work), Error);
}

}  // namespace
}  // namespace dstylize
