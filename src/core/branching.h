#pragma once
#include <cstdint>
#include <limits>
#include <vector>

#include "core/dendrite.h"

namespace dstylize {

/// A run of nodes from one junction to a tip. `nodes[0]` is the parent's node from which it leaves (a
/// root's branch starts at the root itself); every edge of the dendrite lies in exactly one branch.
struct Branch {
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> nodes;
    std::uint32_t parent_branch = kNone;
    std::uint16_t order = 0;  ///< 0 leaves a root, n + 1 leaves a branch of order n
};

/// A dendrite seen as branches: at every fork the child with the longest subtree goes on, the others
/// start branches of their own.
struct Branching {
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> main_child;  ///< kNone at tips
    std::vector<std::uint32_t> tips;        ///< tips in the node's subtree, itself included
    std::vector<Branch> branches;           ///< parents before children
};

/// Cost linear in the dendrite. An isolated root makes no branch.
Branching branching(const Dendrite& dendrite);

}  // namespace dstylize
