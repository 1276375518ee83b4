#pragma once
#include "core/grid.h"

namespace dstylize {

/// Lines around a picture that do not belong to it: a scanner's edge, a black border.
struct Frame {
    int left = 0, top = 0, right = 0, bottom = 0;  ///< pixels on each side
    friend bool operator==(const Frame&, const Frame&) = default;
};

/// Outermost rows and columns of one brightness (deviation below 0.03) that end within 3 % of the side
/// at ones that vary, and two more for the soft edge. A picture with a flat background has none.
Frame flat_frame(const Grid<float>& luma);

/// Replaces the frame by the nearest pixels inside it, so that no stroke follows it.
void paint_over_frame(Grid<float>& luma);

}  // namespace dstylize
