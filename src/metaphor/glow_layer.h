#pragma once
#include "metaphor/emission.h"
#include "metaphor/metaphor.h"

namespace dstylize {

/// The colours and sizes of a glow: what the metaphors of light share. Radii (sigmas) in u.
struct GlowParameters {
    Rgba core{1, 1, 1, 1};
    Rgba inner{0xa8 / 255.0f, 0xd0 / 255.0f, 1, 1};
    Rgba middle{0x4a / 255.0f, 0x7d / 255.0f, 1, 1};
    Rgba outer{0x3b / 255.0f, 0x2f / 255.0f, 0xae / 255.0f, 1};
    float core_gain = 1, inner_gain = 0.8f, middle_gain = 0.7f, outer_gain = 0.55f;
    float inner_radius = 1.85f, middle_radius = 7.2f, outer_radius = 31;
    float exposure = 1.35f;
    float ambient = 1, cast = 0, cast_radius = 31;
    EmissionParameters emission;

    void visit(ParameterVisitor& visitor);
};

/// Every stroke of the subject as light.
Layer glow_layer(const Subject& subject, const GlowParameters& parameters);

/// The 8-bit value whose exposed light is `light`: how the ground of a glow is written, so that the glow's
/// `ambient` and `cast` multiply that light.
Rgba8 exposed_ground(const Rgba& light, float exposure, std::uint8_t alpha);

}  // namespace dstylize
