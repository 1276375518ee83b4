#pragma once
#include <cstdint>
#include <vector>

#include "core/branching.h"
#include "core/display_list.h"
#include "pipeline/growth.h"
#include "stroke/strokes.h"

namespace dstylize {

/// One growth, smooth and with its widths.
struct Candidate {
    PreparedPicture base;
    Grown grown;
    Branching branching;
    std::vector<Centreline> lines;
    std::vector<float> widths;  ///< per node of the dendrite, in lattice steps
};

/// The seed of the best of several growths, from seeds that follow from the run's: the one whose ink, in a preview,
/// shows the picture best; the first of equals. With one growth, or with endpoints given, the run's own.
std::uint64_t best_seed(const Picture& picture, const Style& style, const Controls& controls, const Work& work);
/// The growth from that seed.
Candidate best_candidate(const Picture& picture, const Style& style, const Controls& controls, const Work& work);

/// From the lattice frame to one where the strokes are drawn.
struct StrokeFrame {
    float x_scale, y_scale, width_scale;
    Vec2f px(Vec2f p) const { return {p.x * x_scale, p.y * y_scale}; }
};

/// Centrelines with the widths of their nodes, without colour. A branch begins hidden in its parent.
std::vector<VariableStroke> strokes(const std::vector<Centreline>& lines, const Dendrite& dendrite, const Branching& b,
                                    const std::vector<float>& widths, const StrokeFrame& to);

}  // namespace dstylize
