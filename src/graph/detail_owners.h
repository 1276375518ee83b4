#pragma once
#include <vector>

#include "core/work.h"
#include "graph/plan.h"
#include "graph/planner.h"

namespace dstylize {

/// Whose every node is: its parent's, and its own where a source has no parent. O(nodes).
OwnerColumn owners_by_parents(const ParentColumn& parent, const std::vector<Source>& sources, const Work& work);

}  // namespace dstylize
