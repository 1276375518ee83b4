#pragma once
#include "metaphor/metaphor.h"

namespace dstylize {

/// Leaves along the twigs that show the picture by their own tones. Lengths in u.
struct FoliageParameters {
    float foliage = 0;  ///< leaves per leaf length of twig; 0: a bare tree
    float leaf_size = 9, leaf_aspect = 0.5f;
    float leaf_twig = 3;  ///< only twigs thinner than this bear leaves
    Rgba leaf_light{0xf0 / 255.0f, 0xc8 / 255.0f, 0x62 / 255.0f, 1};
    Rgba leaf_dark{0x5a / 255.0f, 0x26 / 255.0f, 0x10 / 255.0f, 1};
    float leaf_likeness = 1, leaf_variety = 0.16f;

    void visit(ParameterVisitor& visitor);
};

/// One layer of almond leaves in front of the branches, the thickest twigs' first.
Layer foliage_layer(const Subject& subject, const FoliageParameters& parameters);

}  // namespace dstylize
