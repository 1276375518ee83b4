#pragma once
#include <optional>
#include <vector>

#include "core/work.h"
#include "graph/planner.h"
#include "graph/tile_planner.h"

namespace dstylize {

/// The plan for `sum` on an irregular lattice, tile by tile, from distinct sources; nothing where tiles do not serve:
/// edges that lead further than 16 cells, sums that do not fit 32 bits.
std::optional<Plan> plan_listed(const PlanRequest& request, const std::vector<Source>& sources, const Work& work,
                                TileStats& stats);

}  // namespace dstylize
