#pragma once
#include <hwy/cache_control.h>

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

/// Labels, parents and owners of the nodes that a forest leads to from the sources; nothing where a sum is
/// kUnreachedWord or more. At most eight steps, and kMostWalkedNodes. Uses `work.threads` threads. O(nodes).
std::optional<Plan> walk_forest(const WeightedLattice& graph, Forest forest, const std::vector<Source>& sources,
                                const Work& work);

}  // namespace dstylize
