#pragma once
#include <vector>

#include "graph/planner.h"

namespace dstylize {

/// The request's sources, each node once (smallest start, then smallest owner), by node index.
/// Throws Error(bad_usage) as Planner::plan says.
std::vector<Source> distinct_sources(const PlanRequest& request);

/// The request's earlier plan if its labels can only fall: if all it was made from are among these distinct sources,
/// and start no later. Else null.
const Plan* reusable_plan(const PlanRequest& request, const std::vector<Source>& sources);

}  // namespace dstylize
