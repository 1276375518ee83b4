#include <gtest/gtest.h>

#include <vector>

#include "graph/detail_open_edges.h"

namespace dstylize {
namespace {

TEST(OpenEdges, KeepsListsWhetherOrNotTheyFitIntoItsOnePiece) {
    OpenEdges open(20 * sizeof(OpenEdge));
    std::vector<std::span<const OpenEdge>> kept;
    for (std::uint16_t k = 0; k < 12; ++k)
        kept.push_back(open.keep(std::vector<OpenEdge>(k, {TileEdge(1000u + k), k, kNoTree})));
    for (std::uint16_t k = 0; k < 12; ++k) {
        ASSERT_EQ(kept[k].size(), k);
        for (const OpenEdge& e : kept[k]) {
            EXPECT_EQ(e.edge.key, 1000u + k);
            EXPECT_EQ(e.tree, k);
            EXPECT_EQ(e.other, kNoTree);
        }
    }
}

}  // namespace
}  // namespace dstylize
