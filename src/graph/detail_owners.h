#pragma once
#include <cstdint>
#include <vector>

#include "core/grid.h"
#include "core/work.h"
#include "graph/plan.h"
#include "graph/planner.h"

namespace dstylize {

/// Whose every node is, by labels (kUnreached32 where no path leads) and parents. O(nodes).
OwnerColumn owners_by_parents(const UnsetVector<std::uint32_t>& sum, const ParentColumn& parent,
                              const std::vector<Source>& sources, const Work& work);

}  // namespace dstylize
