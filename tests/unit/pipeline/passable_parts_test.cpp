// Connected parts found run by run are those found node by node, in the order of their first nodes.
#include <gtest/gtest.h>

#include "core/noise.h"
#include "pipeline/roots.h"

namespace dstylize {
namespace {

/// Parts by the definition: every node starts alone, and takes the smaller number of each neighbour until nothing
/// changes.
Grid<std::uint32_t> parts_by_definition(const WeightedLattice& g) {
    Grid<std::uint32_t> out(g.lattice.extent(), PassableParts::kNone);
    for (std::uint32_t n = 0; n < out.size(); ++n)
        if (g.passable(NodeId{n})) out[n] = n;
    for (bool changed = true; changed;) {
        changed = false;
        for (std::uint32_t n = 0; n < out.size(); ++n)
            for (int s = 0; s < g.degree(NodeId{n}) && out[n] != PassableParts::kNone; ++s) {
                const NodeId to = g.neighbour(NodeId{n}, s);
                if (to == kNoNode || g.height(NodeId{n}, s) == 0 || out[index(to)] >= out[n]) continue;
                out[n] = out[index(to)];
                changed = true;
            }
    }
    return out;
}

WeightedLattice random_mask(Extent e, Neighbourhood neighbourhood, std::uint64_t seed) {
    WeightedLattice g;
    g.lattice = Lattice(e, neighbourhood);
    const Noise noise(seed, Purpose::jitter);
    for (std::uint32_t n = 0; n < g.lattice.node_count(); ++n)
        g.weight.push_back(noise.unit(n) < 0.4f ? 3 : kImpassable);
    return g;
}

class Parts : public ::testing::TestWithParam<Neighbourhood> {};
INSTANTIATE_TEST_SUITE_P(Lattices, Parts,
                         ::testing::Values(Neighbourhood::square4, Neighbourhood::square8, Neighbourhood::square16));

TEST_P(Parts, AreTheConnectedOnesInRasterOrder) {
    std::size_t most = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        const Extent e{1 + int(seed * 7 % 23), 1 + int(seed * 5 % 19)};
        const WeightedLattice g = random_mask(e, GetParam(), seed);
        const Grid<std::uint32_t> expected = parts_by_definition(g);
        const PassableParts parts = passable_parts(g);
        std::vector<std::uint32_t> first, size(parts.size.size(), 0);
        for (std::uint32_t n = 0; n < expected.size(); ++n) {
            ASSERT_EQ(parts.part[n] == PassableParts::kNone, expected[n] == PassableParts::kNone);
            if (expected[n] == PassableParts::kNone) continue;
            if (expected[n] == n) {
                ASSERT_EQ(parts.part[n], first.size()) << "numbered by their first nodes";
                first.push_back(n);
            }
            ASSERT_EQ(first.at(parts.part[n]), expected[n]) << "node " << n << ", seed " << seed;
            ++size[parts.part[n]];
        }
        ASSERT_EQ(parts.size, size);
        most = std::max(most, size.size());
    }
    EXPECT_GT(most, 10u);
}

}  // namespace
}  // namespace dstylize
