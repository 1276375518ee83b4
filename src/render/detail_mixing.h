#pragma once
#include <cmath>

#include "core/display_list.h"

namespace dstylize {

/// One channel of paint on a ground, both in [0, 1] and opaque.
inline float mixed(Mixing mixing, float below, float paint) {
    switch (mixing) {
        case Mixing::over: return paint;
        case Mixing::multiply: return below * paint;
        case Mixing::screen: return below + paint - below * paint;
        case Mixing::soft_light: {
            if (paint <= 0.5f) return below - (1 - 2 * paint) * below * (1 - below);
            const float lit = below <= 0.25f ? ((16 * below - 12) * below + 4) * below : std::sqrt(below);
            return below + (2 * paint - 1) * (lit - below);
        }
    }
    return paint;
}

}  // namespace dstylize
