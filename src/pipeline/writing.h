#pragma once
#include "core/picture.h"
#include "pipeline/controls.h"
#include "text/text_mask.h"

namespace dstylize {

/// Words on a picture: what they are, how large, and where their middle lies.
struct Writing {
    Lettering lettering;
    float size = 0;  ///< font size as a share of the picture's height; 0: as large as fits
    Coordinate x{0.5, true}, y{0.5, true};

    static constexpr float kLeastSpacing = -0.5f, kMostSpacing = 4, kLeastLines = 0.3f, kMostLines = 5, kMostSize = 4;
};

/// Paper for words that are written on no picture: 1600 pixels on the long side, in the words' proportions.
/// Throws what ink_box throws.
Extent paper_extent(const Writing& writing);

/// The letters in white on black, over a picture of that size. Throws Error(bad_usage) when they would lie
/// outside it, and what text_mask throws.
Picture letter_mask(const Writing& writing, Extent picture_px);

}  // namespace dstylize
