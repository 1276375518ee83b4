#pragma once
#include "importance/fields.h"

namespace dstylize {

/// Three octaves of smooth noise, mean 1/2, in [0, 1], keyed by picture position; each substream is
/// another one, so that every round of growth meets obstacles of its own.
Grid<float> fractal_noise(const Fields& fields, float wavelength_u, std::uint32_t substream);

}  // namespace dstylize
