#pragma once
#include <span>
#include <vector>

#include "core/vec.h"

namespace dstylize {

/// A point of a centreline with the stroke's full width there. The frame is the caller's.
struct WidthPoint {
    Vec2f at;
    float width = 0;
    friend bool operator==(const WidthPoint&, const WidthPoint&) = default;
};
using TaperedLine = std::vector<WidthPoint>;

/// The smooth curve through the points as a denser polyline: centripetal Catmull-Rom for positions
/// (Yuksel, Schaefer & Keyser 2011: no loops within a segment), a monotone cubic for widths (Fritsch &
/// Butland 1984: no swelling between points). The curve leaves the result by about `tolerance` at most;
/// a straight run gets no new points. A turn sharper than 60 degrees is meant and stays a corner.
/// Repeated points are dropped; negative widths count as 0. Both spans have one length.
TaperedLine smooth_line(std::span<const Vec2f> points, std::span<const float> widths, float tolerance);

/// A subset of the points, ends included, that the polyline leaves by at most `tolerance` (Douglas &
/// Peucker 1973), the half width counted as a third coordinate. O(n log n) on ordinary curves.
TaperedLine simplified(std::span<const WidthPoint> line, float tolerance);

}  // namespace dstylize
