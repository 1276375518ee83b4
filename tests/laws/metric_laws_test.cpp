// What each metric promises, checked without any of the planners' own code: against all simple paths
// of tiny graphs, and as fixed points of each law on larger ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>

#include "graph/planner.h"
#include "laws/random_graphs.h"
#include "support/sanitized.h"

namespace dstylize {
namespace {

using test::random_graph;
using test::RandomGraph;

struct Edge {
    NodeId from, to;
    std::uint32_t height;
    std::uint64_t cost;
    /// Position in the total order of edges.
    std::tuple<std::uint32_t, std::uint32_t, std::uint32_t> order() const {
        return {height, std::min(index(from), index(to)), std::max(index(from), index(to))};
    }
};

std::vector<Edge> edges(const WeightedLattice& g) {
    std::vector<Edge> all;
    for (std::uint32_t u = 0; u < g.lattice.node_count(); ++u)
        for (int s = 0; s < int(g.lattice.steps().size()); ++s)
            if (const std::uint32_t h = g.height(NodeId{u}, s))
                all.push_back(
                    {NodeId{u}, g.neighbour(NodeId{u}, s), h, std::uint64_t(h) * g.lattice.steps()[s].length5});
    return all;
}

std::vector<std::vector<Edge>> edges_by_end(const WeightedLattice& g) {
    std::vector<std::vector<Edge>> into(g.lattice.node_count());
    for (const Edge& e : edges(g)) into[index(e.to)].push_back(e);
    return into;
}

/// The smallest start label of each source node.
std::map<NodeId, std::uint64_t> starts(const RandomGraph& g) {
    std::map<NodeId, std::uint64_t> start;
    for (const Source& s : g.sources) {
        const auto [at, fresh] = start.emplace(s.node, s.start);
        if (!fresh) at->second = std::min(at->second, s.start);
    }
    return start;
}

/// Calls `visit(start label, path)` for every simple path from every source, the empty ones included.
void for_all_paths(const RandomGraph& g,
                   const std::function<void(std::uint64_t, NodeId, const std::vector<Edge>&)>& visit) {
    std::vector<std::vector<Edge>> out(g.graph.lattice.node_count());
    for (const Edge& e : edges(g.graph)) out[index(e.from)].push_back(e);
    std::vector<bool> on_path(out.size(), false);
    std::vector<Edge> path;
    std::uint64_t start = 0;
    const std::function<void(NodeId)> walk = [&](NodeId u) {
        visit(start, u, path);
        on_path[index(u)] = true;
        for (const Edge& e : out[index(u)]) {
            if (on_path[index(e.to)]) continue;
            path.push_back(e);
            walk(e.to);
            path.pop_back();
        }
        on_path[index(u)] = false;
    };
    for (const auto& [node, label] : starts(g)) {
        start = label;
        walk(node);
    }
}

Plan reference(const RandomGraph& g, Metric metric) {
    return reference_planner().plan({g.graph, g.sources, metric}, {});
}

constexpr std::uint32_t kTinyGraphs = test::fewer_if_sanitized(4000), kGraphs = test::fewer_if_sanitized(3000);
constexpr int kTinySide = 3, kSide = 14;

TEST(Sum, LabelIsTheLeastOfAllPaths) {
    for (std::uint32_t seed = 0; seed < kTinyGraphs; ++seed) {
        const RandomGraph g = random_graph(seed, kTinySide);
        std::vector<std::uint64_t> least(g.graph.lattice.node_count(), PathLabel::kUnreached);
        for_all_paths(g, [&](std::uint64_t start, NodeId end, const std::vector<Edge>& path) {
            std::uint64_t sum = start;
            for (const Edge& e : path) sum += e.cost;
            least[index(end)] = std::min(least[index(end)], sum);
        });
        const Plan plan = reference(g, Metric::sum);
        for (std::size_t v = 0; v < least.size(); ++v) {
            ASSERT_EQ(plan.label[v].sum, least[v]) << g.shape << ", node " << v;
            ASSERT_EQ(plan.label[v].highest, 0u);
        }
    }
}

TEST(MaxSum, BottleneckIsTheLeastPossible) {
    for (std::uint32_t seed = 0; seed < kTinyGraphs; ++seed) {
        const RandomGraph g = random_graph(seed, kTinySide);
        std::map<NodeId, std::uint32_t> least;
        for_all_paths(g, [&](std::uint64_t, NodeId end, const std::vector<Edge>& path) {
            std::uint32_t highest = 0;
            for (const Edge& e : path) highest = std::max(highest, e.height);
            const auto [at, fresh] = least.emplace(end, highest);
            if (!fresh) at->second = std::min(at->second, highest);
        });
        const Plan plan = reference(g, Metric::max_sum);
        for (const auto& [node, highest] : least) ASSERT_EQ(plan.label[index(node)].highest, highest) << g.shape;
    }
}

TEST(MaxSum, SumIsTheLeastOverTheNeighboursThatKeepTheBottleneck) {
    for (std::uint32_t seed = 0; seed < kGraphs; ++seed) {
        const RandomGraph g = random_graph(seed, kSide);
        const Plan plan = reference(g, Metric::max_sum);
        const auto into = edges_by_end(g.graph);
        const auto start = starts(g);
        for (std::size_t v = 0; v < into.size(); ++v) {
            const auto source = start.find(NodeId{std::uint32_t(v)});
            PathLabel expected;
            if (source != start.end()) {
                expected = {0, source->second};
            } else if (plan.label[v].sum != PathLabel::kUnreached) {
                expected.highest = plan.label[v].highest;
                for (const Edge& e : into[v]) {
                    const PathLabel& u = plan.label[index(e.from)];
                    if (u.sum != PathLabel::kUnreached && std::max(u.highest, e.height) == expected.highest)
                        expected.sum = std::min(expected.sum, u.sum + e.cost);
                }
            }
            ASSERT_EQ(plan.label[v], expected) << g.shape << ", node " << v;
        }
    }
}

TEST(Blend, LabelIsTheBestOverAllNeighbours) {
    for (std::uint32_t seed = 0; seed < kGraphs; ++seed) {
        const RandomGraph g = random_graph(seed, kSide);
        const std::uint32_t factor = seed % 3 == 0 ? 5000 : seed % 3 == 1 ? 7 : 0;
        const Plan plan = reference_planner().plan({g.graph, g.sources, Metric::blend, factor}, {});
        const auto into = edges_by_end(g.graph);
        const auto start = starts(g);
        const auto compared = [&](const PathLabel& l) {
            return std::pair(std::uint64_t(factor) * l.highest + l.sum, l.highest);
        };
        for (std::size_t v = 0; v < into.size(); ++v) {
            std::optional<PathLabel> best;
            const auto consider = [&](PathLabel l) {
                if (!best || compared(l) < compared(*best)) best = l;
            };
            if (const auto at = start.find(NodeId{std::uint32_t(v)}); at != start.end()) consider({0, at->second});
            for (const Edge& e : into[v]) {
                const PathLabel& u = plan.label[index(e.from)];
                if (u.sum != PathLabel::kUnreached) consider({std::max(u.highest, e.height), u.sum + e.cost});
            }
            ASSERT_EQ(plan.label[v], best.value_or(PathLabel{})) << g.shape << ", node " << v;
        }
    }
}

TEST(Lexicographic, PathIsTheLeastOfAllPathsEdgeByEdge) {
    for (std::uint32_t seed = 0; seed < kTinyGraphs; ++seed) {
        const RandomGraph g = random_graph(seed, kTinySide);
        using Key = std::vector<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>>;
        const auto key = [](const std::vector<Edge>& path) {
            Key k;
            for (const Edge& e : path) k.push_back(e.order());
            std::sort(k.begin(), k.end(), std::greater<>());
            return k;
        };
        struct Best {
            Key key;
            std::vector<NodeId> nodes;
            PathLabel label;
        };
        std::map<NodeId, Best> best;
        for_all_paths(g, [&](std::uint64_t start, NodeId end, const std::vector<Edge>& path) {
            const Key k = key(path);
            const auto at = best.find(end);
            if (at != best.end() && at->second.key <= k) return;
            Best b{k, {}, {0, start}};
            for (const Edge& e : path) {
                b.nodes.push_back(e.from);
                b.label.sum += e.cost;
            }
            best[end] = b;
        });
        const Plan plan = reference(g, Metric::lexicographic);
        for (const auto& [end, b] : best) {
            std::vector<NodeId> nodes;
            for (NodeId n = plan.parent[index(end)]; n != kNoNode; n = plan.parent[index(n)]) nodes.push_back(n);
            std::reverse(nodes.begin(), nodes.end());
            ASSERT_EQ(nodes, b.nodes) << g.shape << ", node " << index(end);
            ASSERT_EQ(plan.label[index(end)], b.label) << g.shape << ", node " << index(end);
        }
    }
}

TEST(Lexicographic, TreeIsTheMinimumSpanningForest) {
    for (std::uint32_t seed = 0; seed < kGraphs; ++seed) {
        const RandomGraph g = random_graph(seed, kSide);
        if (!g.graph.symmetric) continue;
        std::vector<Edge> sorted = edges(g.graph);
        std::sort(sorted.begin(), sorted.end(), [](const Edge& a, const Edge& b) { return a.order() < b.order(); });
        std::vector<std::size_t> group(g.graph.lattice.node_count());
        std::iota(group.begin(), group.end(), 0);
        const auto root = [&](std::size_t n) {
            while (group[n] != n) n = group[n] = group[group[n]];
            return n;
        };
        for (const Source& s : g.sources) group[root(index(s.node))] = root(index(g.sources[0].node));
        std::vector<std::pair<NodeId, NodeId>> expected, found;
        const std::vector<bool> reached = test::reachable(g);
        for (const Edge& e : sorted) {
            const std::size_t a = root(index(e.from)), b = root(index(e.to));
            if (a == b || !reached[index(e.from)]) continue;
            group[a] = b;
            expected.push_back(std::minmax(e.from, e.to));
        }
        const Plan plan = reference(g, Metric::lexicographic);
        for (std::uint32_t v = 0; v < plan.parent.size(); ++v)
            if (plan.parent[v] != kNoNode) found.push_back(std::minmax(NodeId{v}, plan.parent[v]));
        std::sort(expected.begin(), expected.end());
        std::sort(found.begin(), found.end());
        ASSERT_EQ(found, expected) << g.shape;
    }
}

}  // namespace
}  // namespace dstylize
