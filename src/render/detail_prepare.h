#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/display_list.h"
#include "core/grid.h"
#include "core/work.h"
#include "geometry/tapered_line.h"
#include "render/raster.h"

namespace dstylize {

/// One item in the raster's sample frame; a stroke has a line, a fill an outline.
struct PreparedItem {
    TaperedLine line;
    std::vector<float> emission;  ///< per point of the line; empty: 1 everywhere
    std::vector<Vec2f> outline;
    std::uint32_t colour = 0;  ///< index into the palette
    std::uint32_t layer = 0;   ///< counted from the first of the given layers
};

/// Consecutive segments of an item that a tile has to look at; a fill has one run of one segment.
struct Run {
    std::uint32_t item = 0, first = 0, last = 0;
};

/// The display list made ready for tiles.
struct Prepared {
    int samples_per_pixel = 1;  ///< along each axis
    int tile_px = 0;            ///< side of a tile; the last ones are cut
    Extent tiles;
    std::vector<Rgba> palette;           ///< the colours of the list, each once
    std::vector<PreparedItem> items;     ///< in painting order, layer after layer
    std::vector<std::vector<Run>> runs;  ///< per tile, in painting order
};

/// Flattens, scales and bins some layers of the list for the output that is asked for. O(points + tiles touched).
Prepared prepared(const DisplayList& list, std::span<const Layer> layers, const RasterOptions& options,
                  const Work& work);

}  // namespace dstylize
