#include "pipeline/prepared_picture.h"

#include <algorithm>

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

}  // namespace

Extent lattice_extent(Extent picture, int detail) {
    const double scale = double(detail) / picture.long_side();
    const auto nodes = [&](int side) { return std::max(1, int(std::lround(side * scale))); };
    return {nodes(picture.x), nodes(picture.y)};
}

PreparedPicture prepared_picture(const Picture& picture, const Style& style, const Controls& controls) {
    const Extent lattice = lattice_extent(picture.extent(), style.lattice.detail);
    UserMaps maps;
    if (controls.importance) maps.importance = resized(luma_plane(*controls.importance), lattice);
    maps.importance_replaces = controls.importance_replaces;
    Grid<float> luma = luma_plane(picture);
    paint_over_frame(luma);
    return {Fields(resized(luma, lattice), style.fields, std::move(maps), controls.seed),
            passable_nodes(picture, style, controls, lattice)};
}

}  // namespace dstylize
