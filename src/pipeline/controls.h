#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/picture.h"
#include "pipeline/style.h"

namespace dstylize {

/// One coordinate as users write it: with a decimal point a fraction of the side, else a pixel of the
/// upright input.
struct Coordinate {
    double value = 0;
    bool is_fraction = false;
    /// In pixels of a side of the given length.
    double px(int side_px) const { return is_fraction ? value * side_px : value + 0.5; }
};

/// A root as a user names it: a place, or a point of the upright input.
struct RootChoice {
    std::optional<RootParameters::Place> place;
    Coordinate x, y;
};

/// One row of an endpoints file.
struct EndpointRow {
    Coordinate x, y;
    std::string stage;  ///< empty: the first
};

/// What a user decides by hand, beside the style.
struct Controls {
    std::optional<Picture> importance;  ///< luma in [0, 1]: multiplied in, or in the place of ours
    bool importance_replaces = false;
    bool no_picture = false;      ///< grow without being led by the picture; its size remains
    std::optional<Picture> mask;  ///< luma below one half: nothing may grow
    std::vector<RootChoice> roots;
    std::vector<EndpointRow> endpoints;
    std::uint64_t seed = 1;
};

}  // namespace dstylize
