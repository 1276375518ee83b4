#pragma once
#include <vector>

#include "core/branching.h"
#include "core/grid.h"
#include "core/parameters.h"

namespace dstylize {

/// The pipe model of trees (Shinozaki et al. 1964): every tip is a pipe that runs down to the root, so that
/// width^exponent adds up at forks, and a little more along the way.
struct PipeParameters {
    float tip = 0.85f;      ///< u: width of a tip
    float exponent = 2.5f;  ///< 2: areas add up (Leonardo's rule); more keeps boughs slender
    float gain = 0.012f;    ///< per u of way, in tips
    float slender = 6;      ///< u: above this widths are compressed ...
    float widest = 30;      ///< u: ... towards this
    float flare = 0.5f, flare_length = 36;

    void visit(ParameterVisitor& visitor);
};

/// Width per node, lattice steps. `u`: lattice steps per u. Linear.
std::vector<float> pipe_widths(const Dendrite& dendrite, const Branching& branching, const PipeParameters& parameters,
                               float u);

/// Share of the area that lines of these widths ink, seen through a Gaussian window; what lies over
/// another is counted as if it lay anywhere (1 - exp(-sum)).
Grid<float> ink_coverage(const Dendrite& dendrite, const std::vector<float>& widths, Extent extent, float sigma);

}  // namespace dstylize
