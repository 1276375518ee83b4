#pragma once
#include <optional>
#include <vector>

#include "core/work.h"
#include "graph/detail_node_record.h"
#include "graph/planner.h"

namespace dstylize {

/// Labels, parents and owners of the nodes that a forest leads to from the sources; nothing where sums do not fit 32
/// bits. Uses `work.threads` threads. O(nodes).
std::optional<Plan> walk_forest(const WeightedLattice& graph, UnsetVector<NodeRecord> nodes,
                                const std::vector<Source>& sources, const Work& work);

}  // namespace dstylize
