#pragma once
#include <optional>
#include <vector>

#include "core/work.h"
#include "graph/planner.h"

namespace dstylize {

/// The plan of the `lexicographic` metric by tiles, from distinct sources; nothing where they do not serve: knight's
/// moves, heights above 65534 or that depend on the way an edge is walked, sums that do not fit 32 bits.
/// O(nodes), but for sorting some half an edge a node, tile by tile.
std::optional<Plan> plan_spanning_forest(const PlanRequest& request, const std::vector<Source>& sources,
                                         std::uint32_t largest_height, const Work& work);

}  // namespace dstylize
