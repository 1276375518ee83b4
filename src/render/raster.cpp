// Tiles of samples: each layer's coverage is collected in one plane, composited onto premultiplied
// colour, averaged to pixels and laid on the paper. A tile depends on nothing but the list.
#include "render/raster.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cassert>
#include <limits>

#include "imaging/filters.h"
#include "render/detail_capsule.h"
#include "render/detail_glow.h"
#include "render/detail_grain.h"
#include "render/detail_mixing.h"
#include "render/detail_polygon.h"
#include "render/detail_prepare.h"
#include "render/detail_relief.h"

namespace dstylize {
namespace {

struct alignas(16) Premultiplied {
    float r = 0, g = 0, b = 0, a = 0;
};

std::uint8_t byte(float v) { return std::uint8_t(std::clamp(v, 0.0f, 1.0f) * 255.0f + 0.5f); }

Rgba8 straight(Premultiplied c) {
    if (c.a <= 0) return {0, 0, 0, 0};
    const float k = 1 / c.a;
    return {byte(c.r * k), byte(c.g * k), byte(c.b * k), byte(c.a)};
}

/// One thread's working memory and the painting of a tile in it.
class TilePainter {
  public:
    TilePainter(const Paper& paper, std::span<const Layer> layers, Mixing mixing, const Prepared& drawing, Picture& out)
        : paper_(paper), layers_(layers), mixing_(mixing), drawing_(drawing), out_(out), grain_(paper.seed) {}

    void paint(int tile_x, int tile_y) {
        const int side = drawing_.tile_px, k = drawing_.samples_per_pixel;
        x0_ = tile_x * side;
        y0_ = tile_y * side;
        width_ = std::min(side, out_.extent().x - x0_);
        height_ = std::min(side, out_.extent().y - y0_);
        const std::size_t samples = std::size_t(width_ * k) * std::size_t(height_ * k);
        plane_.width = width_ * k;
        plane_.height = height_ * k;
        plane_.origin = {float(x0_ * k), float(y0_ * k)};
        plane_.coverage.resize(samples);
        plane_.colour.resize(samples);
        ink_.resize(samples);
        inked_.assign(std::size_t(plane_.height), {});
        paint_items(drawing_.runs[std::size_t(tile_y) * std::size_t(drawing_.tiles.x) + std::size_t(tile_x)]);
        lay_on_paper();
    }

  private:
    void paint_items(const std::vector<Run>& runs) {
        for (std::size_t i = 0; i < runs.size(); ++i) {
            const PreparedItem& item = drawing_.items[runs[i].item];
            if (item.outline.empty())
                paint_segments(plane_, item.line, runs[i].first, runs[i].last, item.colour);
            else
                paint_polygon(plane_, item.outline, item.colour, scratch_);
            const bool merges_with_next =
                i + 1 < runs.size() &&
                (layers_[item.layer].blend == Blend::max ? drawing_.items[runs[i + 1].item].layer == item.layer
                                                         : runs[i + 1].item == runs[i].item);
            if (!merges_with_next) composite();
        }
    }

    /// The samples of a row between which all ink lies.
    struct Span {
        int first = std::numeric_limits<int>::max(), end = 0;
        void add(int x) {
            first = std::min(first, x);
            end = x + 1;
        }
        void add(const Span& other) {
            first = std::min(first, other.first);
            end = std::max(end, other.end);
        }
    };

    /// Lays the plane's coverage over the ink and clears it.
    void composite() {
        for (int y = plane_.dirty.y0; y < plane_.dirty.y1; ++y) {
            float* coverage = plane_.coverage_row(y);
            const std::uint32_t* winner = plane_.colour_row(y);
            Premultiplied* ink = ink_row(y);
            Span span;
            for (int x = plane_.dirty.x0; x < plane_.dirty.x1; ++x) {
                if (coverage[x] == 0) continue;
                const Rgba c = drawing_.palette[winner[x]];
                const float a = coverage[x] * c.a, rest = 1 - a;
                Premultiplied& under = ink[x];
                under = {c.r * a + under.r * rest, c.g * a + under.g * rest, c.b * a + under.b * rest,
                         a + under.a * rest};
                coverage[x] = 0;
                span.add(x);
            }
            inked_[std::size_t(y)].add(span);
        }
        plane_.dirty = {};
    }

    Premultiplied* ink_row(int y) { return ink_.data() + std::size_t(y) * std::size_t(plane_.width); }

    /// The pixels of a row between which all ink lies.
    Span inked_pixels(int y) const {
        const int k = drawing_.samples_per_pixel;
        Span out;
        for (int j = y * k; j < (y + 1) * k; ++j) out.add(inked_[std::size_t(j)]);
        return {out.first / k, (out.end + k - 1) / k};
    }

    Premultiplied mean_ink(int x, int y) const {
        const int k = drawing_.samples_per_pixel;
        const Premultiplied* first = ink_.data() + std::size_t(y * k) * std::size_t(plane_.width) + std::size_t(x * k);
        if (k == 1) return *first;
        Premultiplied sum;
        for (int j = 0; j < k; ++j)
            for (int i = 0; i < k; ++i) {
                const Premultiplied& p = first[std::size_t(j) * std::size_t(plane_.width) + std::size_t(i)];
                sum = {sum.r + p.r, sum.g + p.g, sum.b + p.b, sum.a + p.a};
            }
        const float share = 1.0f / float(k * k);
        return {sum.r * share, sum.g * share, sum.b * share, sum.a * share};
    }

    /// The ground under a pixel of the output.
    Rgba ground(int x, int y) const {
        if (!paper_.picture) return paper_.colour;
        const Picture& picture = *paper_.picture;
        const auto at = [](int i, int count, int size) { return int(std::int64_t(2 * i + 1) * count / (2 * size)); };
        const Rgba8 p = picture(at(x, picture.extent().x, out_.extent().x), at(y, picture.extent().y, out_.extent().y));
        return {float(p.r) / 255, float(p.g) / 255, float(p.b) / 255, float(p.a) / 255};
    }

    void lay_on_paper() {
        const bool textured = paper_.grain > 0 && paper_.colour.a > 0, plain = !textured && !paper_.picture;
        const Rgba p = paper_.colour;
        const Rgba8 bare = straight({std::clamp(p.r, 0.0f, 1.0f) * p.a, std::clamp(p.g, 0.0f, 1.0f) * p.a,
                                     std::clamp(p.b, 0.0f, 1.0f) * p.a, p.a});
        const float* grain = textured ? grain_.block(x0_, y0_, width_, height_).data() : nullptr;
        for (int y = 0; y < height_; ++y) {
            Rgba8* row = out_.row(y0_ + y) + x0_;
            const Span inked = inked_pixels(y);
            if (plain) std::fill(row, row + width_, bare);
            for (int x = plain ? inked.first : 0; x < (plain ? inked.end : width_); ++x) {
                const float light = textured ? 1 + paper_.grain * *grain++ : 1.0f;
                const bool has_ink = x >= inked.first && x < inked.end;
                const Premultiplied ink = has_ink ? mean_ink(x, y) : Premultiplied{};
                const Rgba paper = ground(x0_ + x, y0_ + y);
                const float rest = (1 - ink.a) * paper.a;
                const auto laid = [&](float colour, float ground) {
                    const float lit = std::clamp(ground * light, 0.0f, 1.0f);
                    return over_ground(colour, ink.a, lit, paper.a) + rest * lit;
                };
                row[x] = straight({laid(ink.r, paper.r), laid(ink.g, paper.g), laid(ink.b, paper.b), ink.a + rest});
            }
        }
        for (int y = 0; y < plane_.height; ++y)
            if (const Span span = inked_[std::size_t(y)]; span.first < span.end)
                std::fill(ink_row(y) + span.first, ink_row(y) + span.end, Premultiplied{});
    }

    /// A premultiplied channel of ink as it shows on the ground.
    float over_ground(float ink, float ink_alpha, float ground, float ground_alpha) const {
        if (mixing_ == Mixing::over || ink_alpha <= 0) return ink;
        return (1 - ground_alpha) * ink + ground_alpha * ink_alpha * mixed(mixing_, ground, ink / ink_alpha);
    }

    const Paper& paper_;
    std::span<const Layer> layers_;
    Mixing mixing_;
    const Prepared& drawing_;
    Picture& out_;
    Grain grain_;
    int x0_ = 0, y0_ = 0, width_ = 0, height_ = 0;  ///< the tile's pixels
    CoveragePlane plane_;                           ///< bare between two composites
    std::vector<Premultiplied> ink_;                ///< bare between two tiles
    std::vector<Span> inked_;                       ///< of each row of samples
    std::vector<float> scratch_;
};

/// Layers of paint on paper.
Picture painted(const DisplayList& list, const Paper& paper, std::span<const Layer> layers,
                const RasterOptions& options, const Work& work) {
    Picture out(options.size_px);
    const Prepared drawing = prepared(list, layers, options, work);
    tbb::enumerable_thread_specific<TilePainter> painters(
        [&] { return TilePainter(paper, layers, list.mixing, drawing, out); });
    tbb::parallel_for(std::size_t(0), drawing.tiles.count(), [&](std::size_t tile) {
        work.check();
        painters.local().paint(int(tile) % drawing.tiles.x, int(tile) / drawing.tiles.x);
    });
    return out;
}

/// The first layer of light or relief, or the end.
std::size_t next_effect(std::span<const Layer> layers) {
    std::size_t l = 0;
    while (l < layers.size() && !layers[l].glow && !layers[l].relief) ++l;
    return l;
}

void lay_cover(Picture& out, const Picture& cover) {
    const Picture above = resized(cover, out.extent());
    for (std::size_t n = 0; n < out.size(); ++n) {
        const float a = float(above[n].a) / 255, rest = (1 - a) * float(out[n].a) / 255;
        if (a <= 0) continue;
        const auto over = [&](std::uint8_t c, std::uint8_t below) {
            return (a * float(c) + rest * float(below)) / 255;
        };
        out[n] =
            straight({over(above[n].r, out[n].r), over(above[n].g, out[n].g), over(above[n].b, out[n].b), a + rest});
    }
}

Picture composed(const DisplayList& list, const RasterOptions& options, const Work& work) {
    const Extent size_px = options.size_px;
    std::span<const Layer> rest = list.layers;
    std::size_t paint = next_effect(rest);
    Picture out = painted(list, list.paper, rest.first(paint), options, work);
    for (rest = rest.subspan(paint); !rest.empty(); rest = rest.subspan(paint)) {
        if (rest[0].glow)
            expose(out, emission_plane(list, rest.first(1), size_px, work), *rest[0].glow, work);
        else
            raise(out, body(list, rest[0], size_px, work), list, *rest[0].relief, work);
        rest = rest.subspan(1);
        paint = next_effect(rest);
        if (paint == 0) continue;
        const Paper below{{}, 0, 0, std::make_shared<Picture>(std::move(out))};
        out = painted(list, below, rest.first(paint), options, work);
    }
    if (list.cover) lay_cover(out, *list.cover);
    return out;
}

}  // namespace

Picture raster(const DisplayList& list, const RasterOptions& options, const Work& work) {
    assert(options.size_px.x > 0 && options.size_px.y > 0 && list.width_px > 0 && list.height_px > 0);
    tbb::task_arena arena(work.threads > 0 ? work.threads : tbb::task_arena::automatic);
    return arena.execute([&] { return composed(list, options, work); });
}

}  // namespace dstylize
