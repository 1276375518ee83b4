#pragma once
#include <span>
#include <vector>

#include "graph/graph_distance.h"
#include "graph/planner.h"

// What others do, to measure ourselves against: labels alone, no parents, no owners. They share no code
// with the planners, so that equal labels mean something.
namespace dstylize {

/// Dijkstra with the textbook's binary heap (entries that were overtaken stay and are skipped), tuned: the
/// metric and where heights come from are fixed when compiled, a rim of walls saves the bounds checks,
/// labels are as narrow as they can be. 8 neighbours by node weights, 8 or 16 by height planes, or listed
/// edges. Sources are distinct nodes; sums must fit 32 bits.
LabelColumn heap_labels(const WeightedLattice& graph, std::span<const Source> sources, Metric metric,
                        std::uint32_t blend_factor = 5000);

/// The stippling flood with one heap.
std::vector<NodeId> heap_stipples(const GraphDistanceRequest& request);

/// Boost's Dijkstra (dijkstra_shortest_paths_no_color_map) for `sum` on an 8-connected grid by node weights
/// whose edges are made as they are asked for. It keeps predecessors, too: Boost has no way without.
/// Empty when this build has no Boost.
LabelColumn boost_labels(const WeightedLattice& graph, NodeId source);
bool boost_is_here();

/// OpenCV's intelligent scissors from a source over the same weights, for time alone: its edges cost the
/// weight of the node that they enter, in its own units, and it tells no labels.
void scissors_map(const WeightedLattice& graph, NodeId source);

}  // namespace dstylize
