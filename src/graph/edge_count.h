#pragma once
#include <span>

#include "core/grid.h"
#include "graph/weighted_lattice.h"

namespace dstylize {

/// How many edges away from the nearest of `starts` every node lies, counted up to `most`; `most` + 1
/// beyond and where no path leads (004 s. 5.1 counts the distance from the structure in edges). Linear in
/// the nodes reached.
Grid<std::uint16_t> edge_count(const WeightedLattice& graph, std::span<const NodeId> starts, std::uint16_t most);

}  // namespace dstylize
