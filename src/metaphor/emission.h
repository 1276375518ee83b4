#pragma once
#include <vector>

#include "metaphor/metaphor.h"

namespace dstylize {

/// How brightly strokes shine along their way: keys of a glowing metaphor's table.
struct EmissionParameters {
    float least = 0.12f;
    float tone = 0.85f, tone_gamma = 1.3f;
    float lines = 0.35f;
    float limbs = 1.6f, limbs_exponent = 0.45f;
    float fade = 0.45f;
    float window = 9;

    void visit(ParameterVisitor& visitor);
};

/// One value in [0, 1] per point of every stroke of the subject: the sum of what its parameters say, as a
/// rolling mean along the stroke, faded towards the tip and never much brighter than where it left its parent.
std::vector<std::vector<float>> emission(const Subject& subject, const EmissionParameters& parameters);

}  // namespace dstylize
