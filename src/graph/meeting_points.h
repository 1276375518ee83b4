#pragma once
#include <vector>

#include "graph/planner.h"

namespace dstylize {

/// Nodes where two ways around a hole meet: pairs of neighbours, both among the candidates, whose tree paths have
/// no node in common for `reach` steps back and that grew from one root. Making both of a pair endpoints closes
/// the ring that a tree leaves open. Pairs lie at least `apart` nodes from each other; in raster order.
/// `candidate`: 0 or 1 per node; thin lines such as a medial axis. O(candidates * reach).
std::vector<NodeId> meeting_points(const Lattice& lattice, const Plan& plan, const Grid<std::uint8_t>& candidate,
                                   int reach, float apart);

}  // namespace dstylize
