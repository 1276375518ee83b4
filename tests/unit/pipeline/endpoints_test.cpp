// Endpoint rules: inside the mask, near enough to the structure, no nearer to each other than their spacing.
#include "pipeline/endpoints.h"

#include <gtest/gtest.h>

#include "graph/edge_count.h"
#include "importance/fields.h"

namespace dstylize {
namespace {

constexpr Extent kLatticeExtent{96, 80};

struct Ground {
    Fields fields{Grid<float>(kLatticeExtent, 0.4f), FieldParameters{}, UserMaps{}, 5};
    Grid<std::uint8_t> passable{kLatticeExtent, 1};
    WeightedLattice graph{
        Lattice(kLatticeExtent, Neighbourhood::square8), std::vector<NodeWeight>(kLatticeExtent.count(), 1), {}, true};
    Dendrite drawn;

    Ground() {
        for (int j = 0; j < kLatticeExtent.y; ++j)
            for (int i = 60; i < kLatticeExtent.x; ++i)
                passable(i, j) = 0, graph.weight[index(graph.lattice.at(i, j))] = 0;
        std::uint32_t parent = Dendrite::kRoot;
        for (int j = 70; j > 50; --j) {
            const NodeId node = graph.lattice.at(30, j);
            parent = drawn.add(node, graph.lattice.position_lattice(node), parent, 0, 0);
        }
    }
    std::vector<NodeId> placed(const EndpointParameters& p, int batch = 0, int batches = 1) {
        return placed_endpoints(fields, p, {passable, graph, drawn, 0, batch, batches}, 7, {});
    }
};

/// Spacings of 4 nodes everywhere.
EndpointParameters even_discs(const Fields& fields) {
    EndpointParameters p;
    p.density = p.priority = "crown";
    p.jitter = 4;
    p.calm_spacing = p.dense_spacing = 4 / fields.u();
    return p;
}

TEST(Endpoints, LieInsideTheMask) {
    Ground g;
    for (const auto rule : {EndpointParameters::Rule::discs, EndpointParameters::Rule::stipples}) {
        EndpointParameters p = even_discs(g.fields);
        p.rule = rule;
        const std::vector<NodeId> placed = g.placed(p);
        ASSERT_GT(placed.size(), 50u);
        for (const NodeId n : placed) ASSERT_TRUE(g.passable[index(n)]);
    }
}

TEST(Endpoints, LieWithinTheRadiusOfTheStructureCountedInEdges) {
    Ground g;
    const Grid<std::uint16_t> edges = edge_count(g.graph, g.drawn.node, 1000);
    for (const auto rule : {EndpointParameters::Rule::discs, EndpointParameters::Rule::stipples}) {
        EndpointParameters p = even_discs(g.fields);
        p.rule = rule;
        p.within = 12 / g.fields.u();
        const std::vector<NodeId> placed = g.placed(p);
        ASSERT_GT(placed.size(), 10u);
        for (const NodeId n : placed) ASSERT_LE(edges[index(n)], 12);
    }
}

TEST(Endpoints, KeepTheirSpacingWhichShrinksFromBatchToBatch) {
    Ground g;
    EndpointParameters p = even_discs(g.fields);
    p.first_spacing = 3;
    std::size_t before = 0;
    for (int batch = 0; batch < 3; ++batch) {
        const float spacing = 4 * std::pow(3.0f, 1 - float(batch) / 2);
        const std::vector<NodeId> placed = g.placed(p, batch, 3);
        for (std::size_t a = 0; a < placed.size(); ++a)
            for (std::size_t b = 0; b < a; ++b)
                ASSERT_GT(
                    distance(g.graph.lattice.position_lattice(placed[a]), g.graph.lattice.position_lattice(placed[b])),
                    spacing - 1.5f);
        EXPECT_GT(placed.size(), before);
        before = placed.size();
    }
}

TEST(Endpoints, AreAtMostSoMany) {
    Ground g;
    EndpointParameters p = even_discs(g.fields);
    p.most = 9;
    EXPECT_EQ(g.placed(p).size(), 9u);
}

TEST(Endpoints, AboveMeansStraightUpAsFarAsTheGroundAllows) {
    Ground g;
    EndpointParameters p;
    p.rule = EndpointParameters::Rule::above;
    p.reach = 40 / g.fields.u();
    EXPECT_EQ(g.placed(p), std::vector<NodeId>{g.graph.lattice.at(30, 30)});
    g.graph.weight[index(g.graph.lattice.at(30, 45))] = kImpassable;
    EXPECT_EQ(g.placed(p), std::vector<NodeId>{g.graph.lattice.at(30, 46)});
}

}  // namespace
}  // namespace dstylize
