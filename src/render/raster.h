#pragma once
#include "core/display_list.h"
#include "core/grid.h"
#include "core/picture.h"
#include "core/work.h"

namespace dstylize {

struct RasterOptions {
    /// Output pixels. Each axis is scaled by size / display list size; the two scales are nearly equal.
    Extent size_px;
};

/// The display list painted into pixels of straight alpha; the size of the output is free.
///
/// Colours are composited premultiplied, in sRGB-encoded values as SVG and PDF viewers do it.
/// A paper picture is sampled at pixel centres: bring it to the output's size before.
/// Coverage is the analytic area of a stroke in a square sample; a sample is a pixel when strokes are wide
/// and a fraction of one (down to 1/8) when they are thin, so that hairlines fade instead of breaking
/// and dense ones keep their tone. Grain is keyed by output pixel.
/// The same list and size give the same bytes for any number of threads. Beyond the result it holds
/// the flattened centrelines and, per thread, one tile of at most 128 x 128 samples.
/// Throws Error(cancelled).
Picture raster(const DisplayList& list, const RasterOptions& options, const Work& work);

}  // namespace dstylize
