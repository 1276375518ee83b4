#include "graph/meeting_points.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dstylize {
namespace {

/// Paths from the lowest node of the given nodes, all of one weight.
struct Paths {
    WeightedLattice graph;
    Plan plan;
};
Paths paths_from_below(const Grid<std::uint8_t>& nodes) {
    Paths out{{Lattice(nodes.extent(), Neighbourhood::square8), {}, {}, true}, {}};
    NodeId lowest = kNoNode;
    for (std::uint32_t n = 0; n < nodes.size(); ++n) {
        out.graph.weight.push_back(NodeWeight(nodes[n] ? 10 : 0));
        if (nodes[n]) lowest = NodeId{n};
    }
    const std::vector<Source> sources{{lowest, 0, 0}};
    out.plan = reference_planner().plan({out.graph, sources, Metric::sum, 5000}, {});
    return out;
}

TEST(MeetingPoints, ARingIsClosedOnceOppositeToItsRoot) {
    Grid<std::uint8_t> ring({60, 60});
    for (int j = 0; j < 60; ++j)
        for (int i = 0; i < 60; ++i) ring(i, j) = std::abs(std::hypot(i - 30, j - 30) - 20) < 0.8;
    const Paths p = paths_from_below(ring);
    const auto points = meeting_points(p.graph.lattice, p.plan, ring, 40, 10);
    ASSERT_EQ(points.size(), 2u);
    EXPECT_LT(p.graph.lattice.row(points[0]), 14) << "at the top";
}

TEST(MeetingPoints, ALineWithASideBranchHasNone) {
    Grid<std::uint8_t> line({40, 60});
    for (int j = 5; j < 55; ++j) line(20, j) = 1;
    for (int i = 20; i < 38; ++i) line(i, 25) = 1;
    const Paths p = paths_from_below(line);
    EXPECT_TRUE(meeting_points(p.graph.lattice, p.plan, line, 30, 10).empty());
}

}  // namespace
}  // namespace dstylize
