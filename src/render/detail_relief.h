#pragma once
#include "core/display_list.h"
#include "core/grid.h"
#include "core/picture.h"
#include "core/work.h"

namespace dstylize {

/// A layer of strokes as a body: per output pixel what the highest of them shows there.
struct Body {
    Grid<float> coverage;        ///< in [0, 1]
    Grid<float> height;          ///< above the ground, in pixels, if strokes were round rods half sunk into it
    Grid<float> tip;             ///< 1 at the end of a stroke, falling towards its start
    Grid<std::uint32_t> colour;  ///< index into `palette`
    std::vector<Rgba> palette;
};

/// Fills of the layer are left out. O(points + pixels covered). Beyond the result it holds the flattened lines.
Body body(const DisplayList& list, const Layer& layer, Extent size_px, const Work& work);

/// Lights the body, casts its shadow and lays both on the picture, as layer.relief says. Where the picture is
/// transparent the shadow is a veil of black.
void raise(Picture& below, const Body& body, const DisplayList& list, const Relief& relief, const Work& work);

}  // namespace dstylize
