#pragma once
// Private to this room: the function behind every line of fields.def.
#include "core/noise.h"
#include "importance/fields.h"

namespace dstylize::field {

#define DSTYLIZE_FIELD(name, function, meaning) Grid<float> function(Fields& fields);
#include "importance/fields.def"
#undef DSTYLIZE_FIELD

FlowField flow(Fields& fields);
Grid<std::uint8_t> shape_axis(Fields& fields);
Grid<std::uint8_t> shape_interior(Fields& fields);

/// Noise of the given correlation length, keyed by picture position: cells of `cell_u` on a fixed
/// grid over the picture, so that another detail sees the same noise. Zero mean, unit deviation.
Grid<float> correlated_noise(const Fields& fields, Purpose purpose, float cell_u, float sigma_u,
                             std::uint32_t substream = 0);

}  // namespace dstylize::field
