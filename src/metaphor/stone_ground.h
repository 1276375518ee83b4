#pragma once
#include <memory>

#include "core/picture.h"
#include "metaphor/metaphor.h"

namespace dstylize {

/// A ground of dark, fine-grained stone for what is drawn on no picture: soft clouds, grains, dark pits and pale
/// flecks, lit from the upper left. At the frame's size up to 1600 pixels on the long side. Cost linear in pixels.
std::shared_ptr<const Picture> basalt(const Subject& subject);

}  // namespace dstylize
