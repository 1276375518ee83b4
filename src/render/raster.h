#pragma once
#include "core/display_list.h"
#include "core/grid.h"
#include "core/picture.h"
#include "core/work.h"

namespace dstylize {

struct RasterOptions {
    /// Output pixels. Each axis is scaled by size / display list size; the two scales are nearly equal.
    Extent size_px;
    /// Of samples along each axis, 2 to 8. Fewer are faster; where thin strokes are dense, their ink comes out lower.
    int most_samples_per_pixel = 8;
    /// How far a flattened stroke may be from its curve, in samples. More is faster.
    float flatness_samples = 0.05f;
};

/// The display list painted into pixels of straight alpha; the size of the output is free.
///
/// Colours are composited premultiplied, in sRGB-encoded values as SVG and PDF viewers do it.
/// Coverage is the analytic area of a stroke in a square sample, which is half a pixel wide, and down to 1/8
/// of one when strokes are thinner than 1.5 pixels on average: hairlines fade instead of breaking, and dense
/// ones keep their tone. Strokes are the smooth curves through their points at any size (smooth_line).
/// Grain is keyed by output pixel. A glowing layer is light (see Glow): one float per pixel while it is
/// exposed, and its halos on reduced copies.
/// A paper picture is sampled at pixel centres: bring it to the output's size before.
/// The same list and size give the same bytes for any number of threads. Beyond the result it holds
/// the flattened centrelines and, per thread, one tile of at most 128 x 128 samples.
/// Throws Error(cancelled).
Picture raster(const DisplayList& list, const RasterOptions& options, const Work& work);

}  // namespace dstylize
