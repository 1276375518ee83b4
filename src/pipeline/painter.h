#pragma once
#include <cstdint>

#include "core/picture.h"
#include "core/work.h"

namespace dstylize {

/// `picture` as if it were painted with brushes, at its own size: large strokes first, smaller ones where the
/// canvas still differs from the picture, each along the picture's structures and in one colour (Hertzmann,
/// "Painterly rendering with curved brush strokes of multiple sizes", 1998). Brushes are in shares of `unit_px`
/// (1/1024 of the whole frame's long side): the look does not depend on the size.
/// `strength` in [0, 1]: how coarse the brushes are and how much of the picture they replace; 0: nothing.
/// Transparency stays. Same picture and seed: same pixels, for any number of threads.
/// Throws Error(cancelled).
Picture brushed(const Picture& picture, float unit_px, float strength, std::uint64_t seed, const Work& work);

}  // namespace dstylize
