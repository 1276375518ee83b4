#pragma once
#include "metaphor/metaphor.h"

namespace dstylize {

/// Leaves along the twigs that show the picture by their own tones and hues. Lengths in u.
struct FoliageParameters {
    float foliage = 0;  ///< leaves per leaf length of twig; 0: a bare tree
    float leaf_size = 9, leaf_aspect = 0.5f;
    float leaf_twig = 3;  ///< only twigs thinner than this bear leaves
    float leaf_fill = 0.9f;
    float boughs_seen = 0.6f;  ///< share of the leaves before a bough that lie behind it instead
    Rgba leaf_light{0xf0 / 255.0f, 0xc8 / 255.0f, 0x62 / 255.0f, 1};
    Rgba leaf_middle{0xb4 / 255.0f, 0x5c / 255.0f, 0x1e / 255.0f, 1};
    Rgba leaf_dark{0x5a / 255.0f, 0x26 / 255.0f, 0x10 / 255.0f, 1};
    Rgba leaf_green{0x7c / 255.0f, 0x80 / 255.0f, 0x2e / 255.0f, 1};
    float green_share = 0.2f;
    float leaf_likeness = 1, leaf_variety = 0.16f;
    float hue_variety = 14;
    float own_hue = 0.35f;  ///< share of the picture's own hues
    float leaf_depth = 0.35f, leaf_fold = 0.18f;
    float leaf_under = 0.5f, under_shade = 0.5f;

    void visit(ParameterVisitor& visitor);
};

/// Almond leaves: those behind the branches, in the shade, and those in front of them, the deeper ones first.
/// `light` is the direction light comes from.
struct Foliage {
    Layer behind, front;
};
Foliage foliage(const Subject& subject, const FoliageParameters& parameters, Vec2f light);

}  // namespace dstylize
