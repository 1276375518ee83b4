#pragma once
#include "metaphor/metaphor.h"

namespace dstylize {

/// Ink on paper: what the drawn metaphors share.
struct InkParameters {
    Rgba ink{0x20 / 255.0f, 0x26 / 255.0f, 0x1a / 255.0f, 1};
    Rgba paper{0xf5 / 255.0f, 0xef / 255.0f, 0xe0 / 255.0f, 1};
    float grain = 0.004f;

    void visit(ParameterVisitor& visitor);
};

/// Paper, and every stroke of the subject in one layer of one colour.
DisplayList ink_on_paper(const Subject& subject, const InkParameters& parameters);

}  // namespace dstylize
