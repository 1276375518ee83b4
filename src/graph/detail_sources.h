#pragma once
#include <vector>

#include "graph/planner.h"

namespace dstylize {

/// The request's sources, each node once (smallest start, then smallest owner), by node index.
/// Throws Error(bad_usage) as Planner::plan says.
std::vector<Source> distinct_sources(const PlanRequest& request);

}  // namespace dstylize
