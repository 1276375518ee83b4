#pragma once
#include <algorithm>
#include <cmath>

#include "core/picture.h"

namespace dstylize::test {

/// A picture with what drawings are made of: a bright, calm ground; a dark disc with soft shading; a
/// thin dark line; a small bright spot in the dark.
inline Picture scene(Extent size) {
    Picture out(size);
    for (int j = 0; j < size.y; ++j)
        for (int i = 0; i < size.x; ++i) {
            const float x = (float(i) + 0.5f) / float(size.x), y = (float(j) + 0.5f) / float(size.y);
            const auto away = [&](float cx, float cy) { return std::hypot(x - cx, y - cy); };
            float v = 0.92f - 0.1f * y;
            if (away(0.5f, 0.55f) < 0.3f) v = 0.08f + 0.5f * std::max(0.0f, x - 0.3f);
            if (away(0.45f, 0.5f) < 0.03f) v = 0.95f;
            if (std::abs(y - 0.15f - 0.1f * x) < 0.006f) v = 0.15f;
            const auto g = std::uint8_t(255 * v);
            out(i, j) = {g, g, g, 255};
        }
    return out;
}

inline Picture flat(Extent size, Rgba8 colour) { return Picture(size, colour); }

}  // namespace dstylize::test
