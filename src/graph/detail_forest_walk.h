#pragma once
#include <hwy/cache_control.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/work.h"
#include "graph/planner.h"

namespace dstylize {

/// A node on a walk: one word of memory, in which its label takes shape. Until the node is reached this holds its
/// weight, the steps of its edges in the forest and kUnreachedWord; then, its sum.
using WalkedNode = std::uint32_t;
inline constexpr WalkedNode kUnreachedWord = 0xff000000;
inline constexpr WalkedNode unreached(NodeWeight weight, std::uint8_t steps) {
    return kUnreachedWord | WalkedNode{steps} << 16 | weight;
}

/// The nodes of a lattice and a forest in it.
struct Forest {
    UnsetVector<WalkedNode> node;    ///< unreached, each with its steps
    UnsetVector<std::uint8_t> step;  ///< bit s: the edge by step s is in the forest, from each of its ends

    explicit Forest(std::size_t nodes) : node(nodes), step(nodes) {}
    void add_step(std::uint32_t n, unsigned s) {
        node[n] |= WalkedNode{1} << (16 + s);
        step[n] |= std::uint8_t(1u << s);
    }
    void prefetch(std::uint32_t n) const {
        hwy::Prefetch(&node[n]);
        hwy::Prefetch(&step[n]);
    }
};

/// What a walk can count.
inline constexpr std::size_t kMostWalkedNodes = std::size_t{1} << 29;
inline constexpr std::size_t kMostWalkedSteps = 8;

/// Where a walk is to go on, a stack: nodes that are to be reached, each by a step, with what is known of its sum
/// before it is looked at: all, but for its own weight's share or, with planes of heights, the edge's cost.
struct Frontier {
    UnsetVector<std::uint32_t> place;  ///< place_of(node, step)
    UnsetVector<std::uint32_t> sum;

    /// Places are added as nodes are.
    static constexpr std::uint32_t place_of(std::uint32_t node, unsigned step) { return node << 3 | step; }

    std::size_t size() const { return place.size(); }
    void resize(std::size_t size) {
        place.resize(size);
        sum.resize(size);
    }
    void push(std::uint32_t node_place, std::uint32_t known) {
        place.push_back(node_place);
        sum.push_back(known);
    }
    /// Moves entries from `first` on, so many, to the end of another.
    void move_to(Frontier& other, std::size_t first, std::size_t count);
};

/// The ground of a walk.
struct WalkGround {
    explicit WalkGround(const WeightedLattice& g);
    /// Of the edge to a place, in planes of heights.
    std::uint32_t height_to(std::uint32_t place) const {
        const unsigned step = place % kMostWalkedSteps;
        return graph.height_plane[step / 2][(step % 2 == 0 ? place - ahead[step] : place) >> 3];
    }
    const WeightedLattice& graph;
    /// Of each step the place that it adds to a node's, and its length; as many as a vector has lanes.
    alignas(64) std::array<std::uint32_t, 16> ahead{}, length5{};
};

/// How many nodes walk_on is at once on its way to.
inline constexpr std::size_t kWays = 64;
/// Reaches some of the nodes that lie behind a frontier of kWays nodes at least, many at a time, until few are left or
/// some thousands are reached. False if a sum is kUnreachedWord or more. (Compiled for several instruction sets.)
bool walk_on(const WalkGround& ground, UnsetVector<WalkedNode>& node, Frontier& frontier);

/// Labels, parents and owners of the nodes that a forest leads to from the sources; nothing where a sum is
/// kUnreachedWord or more. At most kMostWalkedSteps steps and kMostWalkedNodes nodes. Uses `work.threads` threads.
/// O(nodes).
std::optional<Plan> walk_forest(const WeightedLattice& graph, Forest forest, const std::vector<Source>& sources,
                                const Work& work);

}  // namespace dstylize
