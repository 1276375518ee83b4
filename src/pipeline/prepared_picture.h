#pragma once
#include "pipeline/controls.h"
#include "pipeline/style.h"

namespace dstylize {

/// A picture brought to the lattice: its fields, and where something may grow.
struct PreparedPicture {
    Fields fields;
    Lattice lattice;
    Grid<std::uint8_t> passable;
};
PreparedPicture prepared_picture(const Picture& picture, const Style& style, const Controls& controls,
                                 const Work& work = {});

}  // namespace dstylize
