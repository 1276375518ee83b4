#pragma once
#include "core/display_list.h"
#include "core/work.h"

namespace dstylize {

/// The list as vector formats can hold it. They have no blurs that all viewers draw alike, nor light cast on a
/// photograph; so what glowing layers do to the ground becomes the paper's picture (long side at most
/// `most_px`), painted layers below them included, and their strokes stay vectors: each in the one colour of
/// its mean light, dim ones first, to be screened over that ground. Layers in relief become part of that picture
/// as a whole. A list without either comes back as it is.
DisplayList with_lit_ground(const DisplayList& list, int most_px, const Work& work);

}  // namespace dstylize
