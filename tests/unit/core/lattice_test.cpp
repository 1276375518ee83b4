#include "core/lattice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace dstylize {
namespace {

TEST(Lattice, NeighbourhoodsNest) {
    const Extent e{5, 4};
    const auto four = Lattice(e, Neighbourhood::square4).steps(), eight = Lattice(e, Neighbourhood::square8).steps(),
               sixteen = Lattice(e, Neighbourhood::square16).steps();
    ASSERT_EQ(four.size(), 4u);
    ASSERT_EQ(eight.size(), 8u);
    ASSERT_EQ(sixteen.size(), 16u);
    EXPECT_EQ(four.data(), sixteen.data());
    EXPECT_EQ(eight.data(), sixteen.data());
}

TEST(Lattice, StepsComeInOppositePairsAndAreAllDifferent) {
    const Lattice lattice({5, 4}, Neighbourhood::square16);
    const auto steps = lattice.steps();
    std::set<std::pair<int, int>> seen;
    for (std::size_t s = 0; s < steps.size(); ++s) {
        EXPECT_EQ(steps[s ^ 1].dx, -steps[s].dx);
        EXPECT_EQ(steps[s ^ 1].dy, -steps[s].dy);
        seen.insert({steps[s].dx, steps[s].dy});
    }
    EXPECT_EQ(seen.size(), 16u);
}

TEST(Lattice, LengthsAreFiveTimesTheRealOnesRounded) {
    for (const Step s : Lattice({2, 2}, Neighbourhood::square16).steps())
        EXPECT_EQ(int(s.length5), int(std::lround(5 * std::hypot(s.dx, s.dy))));
}

TEST(Lattice, RowAndColumnUndoAt) {
    const Lattice lattice({7, 3}, Neighbourhood::square8);
    std::uint32_t expected = 0;
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 7; ++i) {
            const NodeId n = lattice.at(i, j);
            EXPECT_EQ(index(n), expected++);
            EXPECT_EQ(lattice.column(n), i);
            EXPECT_EQ(lattice.row(n), j);
            EXPECT_EQ(lattice.nearest(lattice.position_lattice(n)), n);
        }
    EXPECT_EQ(lattice.node_count(), 21u);
}

TEST(Lattice, NearestNodeIsTheCellThatHoldsThePoint) {
    const Lattice lattice({7, 3}, Neighbourhood::square8);
    EXPECT_EQ(lattice.nearest({2.99f, 1.0f}), lattice.at(2, 1));
    EXPECT_EQ(lattice.nearest({3.0f, 0.99f}), lattice.at(3, 0));
    EXPECT_EQ(lattice.nearest({-5, 100}), lattice.at(0, 2));
    EXPECT_EQ(lattice.nearest({7, -1}), lattice.at(6, 0));
}

}  // namespace
}  // namespace dstylize
