#include "pipeline/prepared.h"

#include <algorithm>
#include <cmath>

#include "graph/scattered_lattice.h"
#include "imaging/filters.h"
#include "importance/frame.h"
#include "pipeline/stylize.h"

namespace dstylize {
namespace {

Grid<std::uint8_t> passable_nodes(const Picture& picture, const Style& style, const Controls& controls,
                                  Extent lattice) {
    constexpr float kHalf = 0.5f, kMostMargin = 0.1f;  // of the short side
    const Grid<float> alpha = resized(alpha_plane(picture), lattice);
    Grid<float> mask;
    if (controls.mask) mask = resized(luma_plane(*controls.mask), lattice);
    const int short_side = std::min(lattice.x, lattice.y);
    const int margin =
        int(std::min(style.lattice.margin * float(lattice.long_side()) / 1024, kMostMargin * float(short_side)));
    Grid<std::uint8_t> out(lattice);
    for (int j = margin; j < lattice.y - margin; ++j)
        for (int i = margin; i < lattice.x - margin; ++i)
            out(i, j) = alpha(i, j) >= kHalf && (mask.empty() || mask(i, j) >= kHalf);
    return out;
}

/// A plane of the picture on the lattice: as large as the frame, or set into it and continued by its rim.
Grid<float> placed(const Grid<float>& plane, Extent lattice, const LatticeParameters& p) {
    if (p.picture_scale == 1 && p.picture_x == 0.5f && p.picture_y == 0.5f) return resized(plane, lattice);
    const auto side = [&](int nodes) { return std::max(1, int(std::lround(double(p.picture_scale) * nodes))); };
    const Grid<float> inner = resized(plane, {side(lattice.x), side(lattice.y)});
    const int left = int(std::lround(p.picture_x * float(lattice.x) - 0.5f * float(inner.extent().x)));
    const int top = int(std::lround(p.picture_y * float(lattice.y) - 0.5f * float(inner.extent().y)));
    Grid<float> out(lattice);
    for (int j = 0; j < lattice.y; ++j)
        for (int i = 0; i < lattice.x; ++i)
            out(i, j) =
                inner(std::clamp(i - left, 0, inner.extent().x - 1), std::clamp(j - top, 0, inner.extent().y - 1));
    return out;
}

Lattice laid_lattice(const Grid<std::uint8_t>& passable, const LatticeParameters& p, std::uint64_t seed,
                     const Work& work) {
    if (p.kind == LatticeParameters::Kind::regular) return Lattice(passable.extent(), p.neighbourhood);
    return scattered_lattice(passable.extent(), passable, Noise(seed, Purpose::jitter), work);
}

}  // namespace

Extent lattice_extent(Extent picture, int detail) {
    const double scale = double(detail) / picture.long_side();
    const auto nodes = [&](int side) { return std::max(1, int(std::lround(side * scale))); };
    return {nodes(picture.x), nodes(picture.y)};
}

Prepared prepared(const Picture& picture, const Style& style, const Controls& controls, const Work& work) {
    const Extent lattice = lattice_extent(picture.extent(), style.lattice.detail);
    UserMaps maps;
    if (controls.importance) maps.importance = placed(luma_plane(*controls.importance), lattice, style.lattice);
    maps.importance_replaces = controls.importance_replaces;
    maps.no_picture = controls.no_picture;
    Grid<float> luma = luma_plane(picture);
    paint_over_frame(luma);
    if (controls.no_picture) luma = Grid<float>(luma.extent(), 0.5f);
    Grid<std::uint8_t> passable = passable_nodes(picture, style, controls, lattice);
    Lattice laid = laid_lattice(passable, style.lattice, controls.seed, work);
    return {Fields(placed(luma, lattice, style.lattice), style.fields, std::move(maps), controls.seed), std::move(laid),
            std::move(passable)};
}

}  // namespace dstylize
