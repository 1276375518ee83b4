#pragma once
#include <cstdint>

#include "core/grid.h"

namespace dstylize {

/// Shapes are grids of 0 (outside) and not 0 (inside); distances are Euclidean, in nodes.

/// Distance of every node to the nearest one inside the shape, 0 inside it; the grid's diagonal everywhere
/// when nothing is inside.
Grid<float> distance_to(const Grid<std::uint8_t>& shape);

/// Signed distance to the outline, which runs half-way between inside and outside nodes: positive inside.
Grid<float> signed_depth(const Grid<std::uint8_t>& shape);

/// The number of the connected part (8 neighbours) of the shape that is nearest to every node, from 0; all
/// zero when nothing is inside. Distances are chamfer distances here, good to 2 %.
Grid<int> nearest_part(const Grid<std::uint8_t>& shape);

/// The medial axis: the shape thinned to lines one node wide (Zhang & Suen 1984). Every connected part keeps
/// at least one node, and stays connected. 1 on the axis. O(nodes + area of the shape).
Grid<std::uint8_t> skeleton(const Grid<std::uint8_t>& shape);

/// Full width of the strokes of which the shape is made: twice the median depth on its skeleton; 0 for an
/// empty shape.
float stem_width(const Grid<std::uint8_t>& shape);

}  // namespace dstylize
