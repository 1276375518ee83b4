#include "core/dendrite.h"

#include <gtest/gtest.h>

namespace dstylize {
namespace {

Dendrite two_branches() {
    Dendrite d;
    const std::uint32_t root = d.add(NodeId{10}, {0, 0}, Dendrite::kRoot, 3, 0);
    const std::uint32_t fork = d.add(NodeId{11}, {1, 0}, root, 3, 0);
    d.add(NodeId{12}, {2, 0}, fork, 3, 0);
    d.add(NodeId{21}, {1, 1}, fork, 3, 1);
    d.add(NodeId{90}, {9, 9}, Dendrite::kRoot, 4, 1);
    return d;
}

TEST(Dendrite, AddReturnsTheNewIndexAndKeepsWhatItWasGiven) {
    Dendrite d = two_branches();
    EXPECT_EQ(d.add(NodeId{91}, {8, 9}, 4, 4, 2), 5u);
    ASSERT_EQ(d.size(), 6u);
    EXPECT_EQ(d.node[5], NodeId{91});
    EXPECT_EQ(d.position_lattice[5], (Vec2f{8, 9}));
    EXPECT_EQ(d.parent[5], 4u);
    EXPECT_EQ(d.owner[5], 4);
    EXPECT_EQ(d.stage[5], 2);
    EXPECT_TRUE(d.is_root(0));
    EXPECT_TRUE(d.is_root(4));
    EXPECT_FALSE(d.is_root(5));
}

TEST(Dendrite, WholeForestsHaveNoFault) {
    EXPECT_EQ(first_fault(Dendrite{}), "");
    EXPECT_EQ(first_fault(two_branches()), "");
}

TEST(Dendrite, FaultsAreNamed) {
    const auto fault = [](auto break_it) {
        Dendrite d = two_branches();
        break_it(d);
        return first_fault(d);
    };
    EXPECT_NE(fault([](Dendrite& d) { d.parent[2] = 2; }), "") << "its own parent";
    EXPECT_NE(fault([](Dendrite& d) { d.parent[1] = 3; }), "") << "a child before its parent";
    EXPECT_NE(fault([](Dendrite& d) { d.parent[2] = 77; }), "") << "no such node";
    EXPECT_NE(fault([](Dendrite& d) { d.owner[2] = 5; }), "") << "another owner";
    EXPECT_NE(fault([](Dendrite& d) { d.stage[1] = 1; }), "") << "a child of an earlier stage";
    EXPECT_NE(fault([](Dendrite& d) { d.owner.pop_back(); }), "") << "a short array";
    EXPECT_NE(fault([](Dendrite& d) { d.node.push_back(NodeId{0}); }), "") << "a long array";
}

}  // namespace
}  // namespace dstylize
