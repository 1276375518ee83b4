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
/// `other`: null, or the same picture prepared for another seed, whose fields are shared where no chance enters
/// them, and whose lattice is where the same nodes are passable. `share_of_detail`: below 1 for a preview.
PreparedPicture prepared_picture(const Picture& picture, const Style& style, const Controls& controls,
                                 const Work& work = {}, const PreparedPicture* other = nullptr,
                                 float share_of_detail = 1);

}  // namespace dstylize
