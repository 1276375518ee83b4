#pragma once
#include <utility>

#include "core/grid.h"
#include "core/picture.h"
#include "imaging/bands.h"

namespace dstylize {

/// The few image filters that fields are built of; sigmas are in nodes. Borders reflect.

/// Gaussian blur. Wide ones (sigma above 8) are made on a reduced copy: same result to about 1 %.
Grid<float> blurred(const Grid<float>& field, float sigma);
/// Magnitude of the Sobel gradient, per node.
Grid<float> gradient_magnitude(const Grid<float>& field);
/// Sobel derivatives, per node.
struct Derivatives {
    Grid<float> x, y;
};
Derivatives derivatives(const Grid<float>& field);
/// The products of the derivatives: a symmetric 2x2 tensor per node. Blurred, its eigenvectors are the local
/// orientation.
struct StructureTensor {
    Grid<float> xx, xy, yy;
};
StructureTensor structure_tensor(const Derivatives& derivatives);
/// The value below which `percent` of the samples lie, to 1/65536 of their range.
float percentile(const Grid<float>& field, float percent);
/// Two percentiles for less than the price of two.
std::pair<float, float> percentiles(const Grid<float>& field, float low_percent, float high_percent);
/// Every sample replaced by the share of samples that are smaller, in [0, 1).
Grid<float> rank(const Grid<float>& field);
/// `field` at another extent: area average when it shrinks, cubic when it grows.
Grid<float> resized(const Grid<float>& field, Extent extent);
/// The same for a picture; transparent pixels lend no colour to their neighbours.
Picture resized(const Picture& picture, Extent extent);

/// Luma of the sRGB values over white, in [0, 1], one per pixel.
Grid<float> luma_plane(const Picture& picture);
/// Alpha in [0, 1], one per pixel.
Grid<float> alpha_plane(const Picture& picture);

/// Applies `f`, which may run on several threads, to every sample in place.
template <class F>
void transform(Grid<float>& field, F f) {
    each_index(field.size(), [&](std::size_t n) { field[n] = f(field[n]); });
}

/// A grid of f, which may run on several threads, of every sample.
template <class F>
Grid<float> transformed(const Grid<float>& field, F f) {
    Grid<float> out = Grid<float>::unset(field.extent());
    each_index(field.size(), [&](std::size_t n) { out[n] = f(field[n]); });
    return out;
}

}  // namespace dstylize
