#pragma once
#include <cstdint>

#include "core/grid.h"

namespace dstylize {

/// One 8-bit sRGB-encoded pixel, straight (not premultiplied) alpha.
struct Rgba8 {
    std::uint8_t r = 0, g = 0, b = 0, a = 255;
    friend bool operator==(const Rgba8&, const Rgba8&) = default;
};

/// A decoded photograph or a finished drawing: upright, sRGB, 4 bytes a pixel.
using Picture = Grid<Rgba8>;

/// A colour in sRGB-encoded floats, straight alpha, each in [0, 1].
struct Rgba {
    float r = 0, g = 0, b = 0, a = 1;
    friend bool operator==(const Rgba&, const Rgba&) = default;
};

/// Luma (Rec. 601 weights) of sRGB-encoded values: what the papers and the recipes call intensity.
inline float luma(Rgba c) { return 0.299f * c.r + 0.587f * c.g + 0.114f * c.b; }

}  // namespace dstylize
