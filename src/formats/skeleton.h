#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "core/dendrite.h"
#include "core/grid.h"
#include "formats/document.h"

namespace dstylize {

/// The drawing before it is dressed: the forest of paths, with what is needed to place it.
struct Skeleton {
    Dendrite dendrite;
    Extent lattice;                        ///< nodes
    Extent picture;                        ///< pixels of the upright input
    std::vector<std::string> stage_names;  ///< may be empty; else one for each stage number in use
    std::vector<float> width_u;            ///< full stroke width at each node; may be empty
};

/// A skeleton as JSON (RFC 8259), one object:
///
///     "format"   "dstylize skeleton"
///     "version"  1
///     "lattice"  [columns, rows]: node id = row * columns + column, at (column + 0.5, row + 0.5)
///     "picture"  [width, height] in pixels; x_px = x * width / columns; the input's, also where the drawing
///                was put into a background
///     "title"    text
///     "info"     object of texts: author, copyright, recipe, ...
///     "stages"   names of the stages, by number
///     "count"    number of entries in each of the following arrays
///     "node"     lattice node it came from; -1 for a point that is not a node
///     "x", "y"   position in lattice steps, y down, to 1/100
///     "parent"   index of an earlier entry; -1 for a root
///     "owner"    number of the root it grew from
///     "stage"    number of the stage that added it; never less than its parent's
///     "width"    full width in u (1/1024 of the picture's long side), to 1/1000; left out when unknown
///
/// Each array is on a line of its own. The same skeleton gives the same bytes.
std::string skeleton_json(const Skeleton& skeleton, const DocumentInfo& info);

/// The skeleton of such a text; positions and widths come back rounded. Keys that are not listed above are
/// ignored. Throws Error(cannot_read) for anything malformed: not JSON, another version, missing or
/// unequal arrays, numbers out of range, more than 512 MB or 2^26 nodes, parents after children.
Skeleton read_skeleton_json(std::string_view text);

}  // namespace dstylize
