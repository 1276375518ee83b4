#pragma once
#include <span>
#include <vector>

#include "geometry/tapered_line.h"

namespace dstylize {

/// The outline of a chain of tapered capsules as one closed polygon for the nonzero fill rule: round
/// ends of the end widths, round joints. Where the line turns more sharply than its width allows, the inner
/// side passes through the centreline point, so that every part winds the same way and the filled
/// shape is exactly the union of the capsules: no holes, no spikes. Arcs leave the true circle by at most
/// `tolerance` and have at least 16 steps a turn, but ends thinner than the tolerance are cut square.
/// One point gives a disc; no point, or no width anywhere, an empty outline. O(points).
std::vector<Vec2f> stroke_outline(std::span<const WidthPoint> line, float tolerance);

}  // namespace dstylize
