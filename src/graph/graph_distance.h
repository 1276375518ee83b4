#pragma once
#include <span>
#include <vector>

#include "core/grid.h"
#include "core/ids.h"
#include "core/work.h"

namespace dstylize {

/// What the stippling floods. *Important = expensive*, the opposite of planning.
struct GraphDistanceRequest {
    /// What one step costs, in [0, 1], one per pixel; between two it is their mean. It is rounded to
    /// multiples of 1/1023, of which a step costs at least one.
    const Grid<float>& expense;
    /// A stipple is due where the cost since the last one exceeds this: stipples lie about
    /// threshold / expense steps apart. In (0, 1e6].
    float threshold = 1;
    /// Nodes to start from at cost 0, by j * width + i: roots, or a structure that is there already.
    /// They become no stipples. Those outside the mask are left out.
    std::span<const NodeId> starts;
    /// Empty, or one per pixel: where it is 0 the flood does not go.
    const Grid<std::uint8_t>& mask;
};

/// Stipples in the order in which they were placed (Mould 2007; Long & Mould 2009, s. 4.2): best-first
/// search over the 4-connected lattice, cheapest frontier node first, then smallest index, each node
/// expanded once; when the cheapest costs more than the threshold it becomes a stipple and its cost 0.
/// A part of the mask that no start lies in starts from its first node, which becomes no stipple.
/// O(n) but for heaps of the frontier's nodes of one cost; 4 bytes a node, 8 where costs do not fit 22 bits. Only what
/// goes before and after the search has several threads. Throws Error(cancelled).
std::vector<NodeId> graph_distance_stipples(const GraphDistanceRequest& request, const Work& work);

}  // namespace dstylize
