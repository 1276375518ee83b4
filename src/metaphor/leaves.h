#pragma once
#include "metaphor/metaphor.h"

namespace dstylize {

/// Leaves in calm, bright parts of the picture: the [vine] table's `leaf_…` keys. Lengths in u.
struct LeafParameters {
    bool grow = true;
    float size = 15.5f, aspect = 0.36f, gap = 1.2f;
    float spacing = 10;
    float angle_deg = 51;
    float stem = 2.2f;
    float outline = 0.75f;
    int at_least = 60;
    Rgba fill{0x9a / 255.0f, 0xa7 / 255.0f, 0x7a / 255.0f, 1};

    void visit(ParameterVisitor& visitor);
};

/// One almond-shaped leaf in the picture frame.
struct Leaf {
    Vec2f base_px;
    float angle_rad = 0, length_px = 0, bend_px = 0;
};

/// Leaves at the tips first, then alternating along thin stems, wherever the field `calm` is 1 and
/// neither ink nor another leaf is in the way. None at all when fewer than `at_least` fit: three stray
/// leaves look like a mistake.
std::vector<Leaf> placed_leaves(const Subject& subject, const LeafParameters& parameters);

/// Two layers: the fills, and the outlines and midribs in ink.
void add_leaf_layers(DisplayList& list, const std::vector<Leaf>& leaves, const LeafParameters& parameters, Rgba ink,
                     float u_px);

}  // namespace dstylize
