#pragma once
#include <functional>

#include "core/dendrite.h"
#include "core/work.h"
#include "pipeline/prepared_picture.h"

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
    /// Of a unit of length at each node of the dendrite, 0 elsewhere; empty when no width follows it.
    Grid<float> node_cost;
};

/// Runs the stages of a style, each in its batches: weights, endpoints, plan, graft. `observer` may be empty.
Grown grow(PreparedPicture& base, const Style& style, const Controls& controls, Extent picture_px,
           const StageObserver& observer, const Work& work);

}  // namespace dstylize
