#include "pipeline/prepared_picture.h"

#include <algorithm>
#include <cmath>

#include "graph/listed_lattices.h"
#include "graph/scattered_lattice.h"
#include "imaging/filters.h"
#include "imaging/skeleton.h"
#include "importance/frame.h"
#include "pipeline/stylize.h"

namespace dstylize {
namespace {

/// 1 where the picture is not transparent.
Grid<std::uint8_t> opaque_nodes(const Picture& picture, Extent lattice) {
    constexpr float kHalf = 0.5f, kAlmostNothing = 0.5f / 255;
    if (std::all_of(picture.begin(), picture.end(), [](Rgba8 p) { return p.a == 255; }))
        return Grid<std::uint8_t>(lattice, 1);
    const Grid<float> alpha = resized(alpha_plane(picture), lattice);
    // An evenly translucent picture is a picture, too: what counts is how opaque a place is beside the others.
    const float least_alpha = std::max(kHalf * *std::max_element(alpha.begin(), alpha.end()), kAlmostNothing);
    Grid<std::uint8_t> out(lattice);
    each_index(out.size(), [&](std::size_t n) { out[n] = alpha[n] >= least_alpha; });
    return out;
}

Grid<std::uint8_t> passable_nodes(const Picture& picture, const Style& style, const Controls& controls,
                                  Fields& fields) {
    constexpr float kMostMargin = 0.1f;  // of the short side
    const Extent lattice = fields.extent();
    const int short_side = std::min(lattice.x, lattice.y);
    const int margin = int(std::min(style.lattice.margin * fields.u(), kMostMargin * float(short_side)));
    Grid<std::uint8_t> out = opaque_nodes(picture, lattice);
    if (const Grid<std::uint8_t>* mask = controls.mask ? &fields.shape_interior() : nullptr)
        each_index(out.size(), [&](std::size_t n) { out[n] = out[n] && (*mask)[n]; });
    for (int j = 0; j < lattice.y; ++j) {
        const bool inside = j >= margin && j < lattice.y - margin;
        std::fill_n(out.row(j), inside ? margin : lattice.x, std::uint8_t{0});
        std::fill_n(out.row(j) + lattice.x - margin, margin, std::uint8_t{0});
    }
    return out;
}

/// The mask's strokes in pixels of a picture of that size, measured on a reduced copy.
float stem_px(const Picture& mask, Extent picture) {
    constexpr int kMostSide = 1200;
    constexpr float kHalf = 0.5f;
    const Grid<float> luma = luma_plane(mask);
    const Extent e = luma.extent().long_side() > kMostSide ? lattice_extent(luma.extent(), kMostSide) : luma.extent();
    const Grid<float> small = resized(luma, e);
    Grid<std::uint8_t> shape(e);
    std::transform(small.begin(), small.end(), shape.begin(), [](float v) { return std::uint8_t(v >= kHalf); });
    return stem_width(shape) * float(picture.long_side()) / float(e.long_side());
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
    const Noise noise(seed, Purpose::jitter);
    switch (p.kind) {
        case LatticeParameters::Kind::regular:
            if (p.jitter > 0) return moved_squares(p.neighbourhood, p.jitter, passable, noise, work);
            return Lattice(passable.extent(), p.neighbourhood);
        case LatticeParameters::Kind::hexagon: return hexagon_lattice(p.jitter, passable, noise, work);
        case LatticeParameters::Kind::scattered: return scattered_lattice(passable.extent(), passable, noise, work);
    }
    return {};
}

}  // namespace

Extent lattice_extent(Extent picture, int detail) {
    const double scale = double(detail) / picture.long_side();
    const auto nodes = [&](int side) { return std::max(1, int(std::lround(side * scale))); };
    return {nodes(picture.x), nodes(picture.y)};
}

LatticeScale lattice_scale(Extent picture, const LatticeParameters& parameters, const Picture* mask) {
    constexpr float kMostNodes = 4096;
    const auto side = float(picture.long_side());
    const float stem = mask && parameters.stem > 0 ? stem_px(*mask, picture) : 0;
    float nodes = float(parameters.detail), u_px = side / 1024;
    if (stem > 0) {
        u_px = stem / parameters.stem;
        nodes = std::clamp(side / u_px * nodes / 1024, 16.0f, kMostNodes);
    }
    const Extent lattice = lattice_extent(picture, int(std::lround(nodes)));
    return {lattice, u_px * float(lattice.long_side()) / side};
}

PreparedPicture prepared_picture(const Picture& picture, const Style& style, const Controls& controls, const Work& work,
                                 const PreparedPicture* other, float share_of_detail) {
    LatticeParameters detailed = style.lattice;
    detailed.detail = std::max(1, int(std::lround(share_of_detail * float(detailed.detail))));
    const LatticeScale scale = lattice_scale(picture.extent(), detailed, controls.mask ? &*controls.mask : nullptr);
    UserMaps maps;
    if (controls.importance) maps.importance = placed(luma_plane(*controls.importance), scale.extent, style.lattice);
    maps.importance_replaces = controls.importance_replaces;
    maps.no_picture = controls.no_picture;
    if (controls.mask) maps.mask = resized(luma_plane(*controls.mask), scale.extent);
    Grid<float> luma = luma_plane(picture);
    paint_over_frame(luma);
    if (controls.no_picture) luma = Grid<float>(luma.extent(), 0.5f);
    Fields fields(placed(luma, scale.extent, style.lattice), style.fields, std::move(maps), controls.seed,
                  scale.nodes_per_u);
    if (other) fields.share(other->fields);
    Grid<std::uint8_t> passable = passable_nodes(picture, style, controls, fields);
    const bool same_ground = other && std::equal(passable.begin(), passable.end(), other->passable.begin());
    Lattice lattice = same_ground ? other->lattice : laid_lattice(passable, style.lattice, controls.seed, work);
    return {std::move(fields), std::move(lattice), std::move(passable)};
}

}  // namespace dstylize
