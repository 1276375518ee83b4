#pragma once
#include <span>
#include <vector>

#include "core/vec.h"

namespace dstylize {

/// One piece of a path: a cubic Bezier curve from the point before it, or a straight line.
struct CubicPiece {
    Vec2f control1, control2, end;
    bool straight = false;  ///< the controls mean nothing
};

/// A closed path; the last piece ends at `start`.
struct CubicPath {
    Vec2f start;
    std::vector<CubicPiece> pieces;
};

/// Few cubic pieces that follow a closed polygon within `tolerance` (Schneider 1990). Turns above 40
/// degrees stay sharp; elsewhere the path is smooth. Empty for fewer than three distinct points. About
/// O(n log n).
CubicPath fitted_path(std::span<const Vec2f> polygon, float tolerance);

}  // namespace dstylize
