#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "render/detail_samples.h"

namespace dstylize {

/// Paints a closed polygon with the exact area that it covers of each sample. Overlapping parts of one
/// winding count once (nonzero rule, up to samples where outlines cross). `outline` is in samples of the
/// whole raster, `scratch` is working memory that the caller keeps.
void paint_polygon(CoveragePlane& plane, std::span<const Vec2f> outline, std::uint32_t colour,
                   std::vector<float>& scratch);

}  // namespace dstylize
