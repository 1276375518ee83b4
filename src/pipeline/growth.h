#pragma once
#include <functional>

#include "core/dendrite.h"
#include "core/work.h"
#include "pipeline/controls.h"
#include "pipeline/style.h"

namespace dstylize {

/// What one stage worked with; for --show and statistics.
struct StageView {
    const StageParameters& stage;
    const WeightedLattice& graph;
    const Plan& plan;
    const std::vector<NodeId>& endpoints;
};
using StageObserver = std::function<void(const StageView&)>;

struct Grown {
    Dendrite dendrite;
    std::vector<std::size_t> endpoints;  ///< placed, per stage
    std::size_t unreached = 0;           ///< endpoints without a path
    Grid<float> node_cost;               ///< of a unit of length at each node of the dendrite, 0 elsewhere
};

/// Runs the stages of a style: weights, endpoints, plan, graft. `passable`: 0 where nothing may grow.
/// `observer` may be empty.
Grown grow(Fields& fields, const Grid<std::uint8_t>& passable, const Style& style, const Controls& controls,
           Extent picture_px, const StageObserver& observer, const Work& work);

}  // namespace dstylize
