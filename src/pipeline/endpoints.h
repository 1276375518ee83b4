#pragma once
#include <vector>

#include "core/dendrite.h"
#include "core/work.h"
#include "pipeline/controls.h"
#include "pipeline/style.h"

namespace dstylize {

/// What an endpoint rule may look at: the stage's graph, what is drawn so far, and which round it is.
struct EndpointView {
    const Grid<std::uint8_t>& passable;
    const WeightedLattice& graph;
    const Dendrite& drawn;
    std::uint32_t stage = 0;
    int batch = 0, batches = 1;
};

/// Where the paths of one batch of a stage must arrive, by the stage's rule: passable nodes only, not
/// farther from the structure than `within`, spacings shrinking from the first batch to the last.
std::vector<NodeId> placed_endpoints(Fields& fields, const EndpointParameters& parameters, const EndpointView& view,
                                     std::uint64_t seed, const Work& work);

}  // namespace dstylize
