#pragma once
#include <utility>
#include <vector>

#include "graph/plan.h"

namespace dstylize {

/// A plan as planners write it that settle one node after the other: whatever a node may get fits.
struct WidePlan {
    explicit WidePlan(std::size_t nodes) : label(nodes), parent(nodes, kNoNode), owner(nodes, Plan::kNoOwner) {}
    Plan finished() && { return {std::move(label), std::move(parent), std::move(owner)}; }
    std::vector<PathLabel> label;
    std::vector<NodeId> parent;
    std::vector<std::uint16_t> owner;
};

}  // namespace dstylize
