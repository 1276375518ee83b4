#pragma once
#include "metaphor/metaphor.h"

namespace dstylize {

/// Strokes as round limbs: the part of a metaphor's table that paints bark. Lengths in u.
struct BarkParameters {
    Rgba lit{0x80 / 255.0f, 0x66 / 255.0f, 0x4e / 255.0f, 1};
    Rgba shade{0x1c / 255.0f, 0x15 / 255.0f, 0x13 / 255.0f, 1};
    float light_deg = 222;     ///< where light comes from: 0 right, 90 below, 180 left, 270 above
    float round_from = 1.8f;   ///< limbs wider than this are shaded
    float furrows = 0.6f;      ///< opacity of the furrows
    float furrow_from = 5;     ///< limbs wider than this have some
    float twig_shade = 0.72f;  ///< how dark the thinnest twigs are: 0 lit, 1 shade
    float twig_tone = 0.4f;    ///< how much that follows the picture
    Rgba haze{0xc9 / 255.0f, 0xbf / 255.0f, 0xac / 255.0f, 1};
    float back_haze = 0.5f, back_width = 0.8f;

    void visit(ParameterVisitor& visitor);
};

/// One layer for every layer of strokes, the farthest first and hazy; in each, thin strokes lie below thick
/// ones, so that boughs hide what grows behind them. A limb is its shadow-coloured outline, ever narrower and lighter
/// strokes inside it, moved towards the light as on a cylinder, and furrows that run along it: vectors, in any output.
std::vector<Layer> bark_layers(const Subject& subject, const BarkParameters& parameters);

}  // namespace dstylize
