#pragma once
#include <cstdint>
#include <span>

#include "geometry/tapered_line.h"
#include "render/detail_samples.h"

namespace dstylize {

/// Thinner ends than this half width, in samples, are cut square at equal area: a round cap cannot be
/// told from a square one there, and a distance to its centre would lengthen it by a large part of a sample.
inline constexpr float kThinRadius = 0.7f;

/// Makes the last 1.5 samples at each thin end one straight segment, so that the square cut of the
/// end acts on all of the stroke that is near it. The line is in samples.
void straighten_thin_ends(TaperedLine& line);

/// Paints segments first..last (segment i joins points i and i + 1; a line of one point is a disc) as
/// tapered capsules. A capsule is the convex hull of two discs. Coverage is the area of a unit square
/// sample that a straight strip with the stroke's local edges covers: exact for straight strokes of
/// any width and direction. At joints only the wedge that no body covers is painted, so the joints
/// of a line cannot be seen and long wide strokes cost their area.
/// `emission`: empty, or a factor per point of the line on the coverage there, linear between points.
void paint_segments(CoveragePlane& plane, std::span<const WidthPoint> line, std::size_t first, std::size_t last,
                    std::uint32_t colour, std::span<const float> emission = {});

}  // namespace dstylize
