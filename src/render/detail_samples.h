#pragma once
#include <cstdint>
#include <vector>

#include "core/vec.h"

namespace dstylize {

/// Half-open rectangle of samples.
struct SampleRect {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    bool empty() const { return x0 >= x1 || y0 >= y1; }
    void include(int left, int top, int right, int bottom) {
        if (empty()) {
            *this = {left, top, right, bottom};
            return;
        }
        x0 = left < x0 ? left : x0;
        y0 = top < y0 ? top : y0;
        x1 = right > x1 ? right : x1;
        y1 = bottom > y1 ? bottom : y1;
    }
};

/// Coverage below this is rounding noise of the coverage formulas, not ink.
inline constexpr float kLeastCoverage = 1.0f / 4096;

/// What has been painted of one layer (or one item of an `over` layer) in one tile: per sample the
/// largest coverage and the colour of the item that had it; of equal ones the later.
struct CoveragePlane {
    int width = 0, height = 0;
    Vec2f origin;  ///< of the tile, in samples of the whole raster
    std::vector<float> coverage;
    std::vector<std::uint32_t> colour;  ///< index into the palette; says nothing where coverage is 0
    SampleRect dirty;                   ///< outside of it coverage is 0

    float* coverage_row(int y) { return coverage.data() + std::size_t(y) * std::size_t(width); }
    std::uint32_t* colour_row(int y) { return colour.data() + std::size_t(y) * std::size_t(width); }
};

}  // namespace dstylize
