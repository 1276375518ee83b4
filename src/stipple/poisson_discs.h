#pragma once
#include <vector>

#include "core/grid.h"
#include "core/ids.h"
#include "core/noise.h"

namespace dstylize {

/// Nodes that no further endpoint may take; filled as discs are placed. 0: free.
using Occupancy = Grid<std::uint8_t>;

/// Marks the disc of the given radius (nodes) around a node.
void occupy(Occupancy& occupancy, int column, int row, float radius);

struct DiscRequest {
    const Grid<float>& priority;                 ///< who comes first, in [0, 1]
    const Grid<float>& density;                  ///< in [0, 1]; 0: calm spacing, 1: dense spacing
    float priority_at_least = 0;                 ///< none below
    float jitter = 0;                            ///< random share added to the priority
    float calm_spacing = 26, dense_spacing = 3;  ///< nodes; between them geometric in the density
    Noise noise;                                 ///< of the jitter, by node
};

/// Disc radius at a density: calm * (dense / calm)^density.
float disc_radius(const DiscRequest& request, float density);

/// Greedy Poisson disc sampling with radii that follow a field: nodes in order of priority, each
/// taken unless an earlier disc (or the caller's marks in `occupancy`) covers it. Endpoints come in
/// order of priority; `occupancy` holds their discs afterwards. O(nodes + area of the discs).
std::vector<NodeId> poisson_discs(const DiscRequest& request, Occupancy& occupancy);

}  // namespace dstylize
