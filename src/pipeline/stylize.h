#pragma once
#include <functional>

#include "core/dendrite.h"
#include "core/display_list.h"
#include "core/work.h"
#include "pipeline/controls.h"
#include "pipeline/style.h"

namespace dstylize {

/// A finished drawing, independent of any output's size, and what it was drawn from.
struct Drawing {
    DisplayList list;
    Dendrite dendrite;           ///< smoothed positions
    std::vector<float> width_u;  ///< per node of the dendrite, in u
    Extent lattice, picture;     ///< nodes; pixels of the upright input
    std::vector<std::string> stage_names;
    std::vector<std::size_t> endpoints;  ///< placed, per stage
    std::size_t unreached = 0;           ///< endpoints without a path
    std::size_t strokes = 0;
};

/// The lattice for a picture: `detail` nodes on the long side, at least one on the short.
Extent lattice_extent(Extent picture_px, int detail);

/// The lattice of a drawing and the style's unit of length on it.
struct LatticeScale {
    Extent extent;
    float nodes_per_u = 1;
};
/// `mask` may be null. With a mask and a style that says how wide its strokes are (`lattice.stem`), u follows
/// the strokes, and the lattice has as many nodes per u as it has otherwise, up to 4096 on the long side: the
/// drawing of a letter is the same whatever the size of the letter or of the picture.
LatticeScale lattice_scale(Extent picture_px, const LatticeParameters& parameters, const Picture* mask);

/// The whole way from a picture to a drawing. Same picture, style, controls: same drawing, for any
/// number of threads. O(n log n) in the lattice's nodes. Throws Error.
Drawing stylize(const Picture& picture, const Style& style, const Controls& controls, const Work& work = {});

/// What `--show NAME` can show beside the fields.
std::vector<std::string> shown_names(const Style& style);

/// Intermediates of one run as pictures at the lattice's size, in the names' order: fields, `flow`, or
/// `weights`, `endpoints`, `distance`, `owners`, `tree`, each of a stage (`weights:tone`; the last by default).
std::vector<Picture> shown(const std::vector<std::string>& names, const Picture& picture, const Style& style,
                           const Controls& controls, const Work& work = {});

}  // namespace dstylize
