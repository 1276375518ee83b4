// Light instead of paint: an emission plane, its halos, and an exposure that never clips.
// Wide blurs have nothing that a reduced copy could not hold, so that a halo costs a small share of the plane.
#include "render/detail_glow.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "imaging/filters.h"
#include "render/detail_capsule.h"
#include "render/detail_polygon.h"
#include "render/detail_prepare.h"

namespace dstylize {
namespace {

struct EmissionTile {
    CoveragePlane plane;
    std::vector<float> scratch;
};

void paint_tile(EmissionTile& tile, const Prepared& drawing, int tile_x, int tile_y, Grid<float>& out) {
    const int side = drawing.tile_px, k = drawing.samples_per_pixel;
    const int x0 = tile_x * side, y0 = tile_y * side;
    const int width = std::min(side, out.extent().x - x0), height = std::min(side, out.extent().y - y0);
    CoveragePlane& plane = tile.plane;
    plane.width = width * k;
    plane.height = height * k;
    plane.origin = {float(x0 * k), float(y0 * k)};
    plane.coverage.assign(std::size_t(plane.width) * std::size_t(plane.height), 0.0f);
    plane.colour.resize(plane.coverage.size());
    plane.dirty = {};
    for (const Run& run : drawing.runs[std::size_t(tile_y) * std::size_t(drawing.tiles.x) + std::size_t(tile_x)]) {
        const PreparedItem& item = drawing.items[run.item];
        if (item.outline.empty())
            paint_segments(plane, item.line, run.first, run.last, 0, item.emission);
        else
            paint_polygon(plane, item.outline, 0, tile.scratch);
    }
    const float share = 1.0f / float(k * k);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            float sum = 0;
            for (int j = 0; j < k; ++j) {
                const float* row = plane.coverage_row(y * k + j) + x * k;
                for (int i = 0; i < k; ++i) sum += row[i];
            }
            out(x0 + x, y0 + y) = sum * share;
        }
}

/// A blurred copy of a plane, reduced, read at the positions of the plane's pixels.
class Halo {
  public:
    Halo(const Grid<float>& plane, float sigma_px) {
        constexpr float kLeastSigma = 3;  // samples: below this a reduced blur shows its grid
        const float factor = std::max(1.0f, std::floor(sigma_px / kLeastSigma));
        const Extent full = plane.extent();
        const auto reduced = [&](int side) { return std::max(1, int(std::lround(float(side) / factor))); };
        copy_ = resized(plane, {reduced(full.x), reduced(full.y)});
        if (sigma_px > 0.2f) copy_ = blurred(copy_, sigma_px / factor);
        scale_ = {float(copy_.extent().x) / float(full.x), float(copy_.extent().y) / float(full.y)};
    }

    /// Row y of the plane into `out`, one value per pixel.
    void read_row(int y, std::vector<float>& out) const {
        const Extent e = copy_.extent();
        const float v = std::clamp((float(y) + 0.5f) * scale_.y - 0.5f, 0.0f, float(e.y - 1));
        const int j = std::min(int(v), std::max(0, e.y - 2));
        const float* above = copy_.row(j);
        const float* under = copy_.row(std::min(j + 1, e.y - 1));
        const float fy = v - float(j);
        for (std::size_t x = 0; x < out.size(); ++x) {
            const float u = std::clamp((float(x) + 0.5f) * scale_.x - 0.5f, 0.0f, float(e.x - 1));
            const int i = std::min(int(u), std::max(0, e.x - 2)), next = std::min(i + 1, e.x - 1);
            const float fx = u - float(i);
            const float top = above[i] + (above[next] - above[i]) * fx;
            const float bottom = under[i] + (under[next] - under[i]) * fx;
            out[x] = top + (bottom - top) * fy;
        }
    }

  private:
    Grid<float> copy_;
    Vec2f scale_;
};

using Channels = std::array<float, 3>;
Channels channels(Rgba c) { return {c.r, c.g, c.b}; }

/// ln(1 - v/255): the (negative) exposed light of an 8-bit value. White is as bright as half a step below it.
std::array<float, 256> log_transmission_table() {
    std::array<float, 256> out;
    for (int v = 0; v < 256; ++v) out[std::size_t(v)] = std::log(std::max(1 - float(v) / 255, 0.5f / 255));
    return out;
}

Rgba8 exposed(Rgba8 below, const Channels& light, float below_gain, const std::array<float, 256>& log_transmission) {
    const auto byte = [](float v) { return std::uint8_t(std::clamp(v, 0.0f, 1.0f) * 255.0f + 0.5f); };
    const std::array<std::uint8_t, 3> under{below.r, below.g, below.b};
    Channels premultiplied;
    float opacity = 0;
    const float alpha = float(below.a) / 255;
    for (std::size_t c = 0; c < 3; ++c) {
        const float through = std::exp(-light[c]);
        opacity = std::max(opacity, 1 - through);
        if (below.a == 255) {
            premultiplied[c] = 1 - std::exp(below_gain * log_transmission[under[c]]) * through;
        } else {
            const float dimmed = 1 - std::exp(below_gain * log_transmission[under[c]]);
            premultiplied[c] = 1 - through + alpha * dimmed * through;
        }
    }
    if (below.a == 255) return {byte(premultiplied[0]), byte(premultiplied[1]), byte(premultiplied[2]), 255};
    const float a = opacity + alpha * (1 - opacity);
    if (a <= 0) return {0, 0, 0, 0};
    return {byte(premultiplied[0] / a), byte(premultiplied[1] / a), byte(premultiplied[2] / a), byte(a)};
}

}  // namespace

Grid<float> emission_plane(const DisplayList& list, std::span<const Layer> glowing, Extent size_px, const Work& work) {
    Grid<float> out(size_px);
    const Prepared drawing = prepared(list, glowing, {size_px}, work);
    tbb::enumerable_thread_specific<EmissionTile> tiles;
    tbb::parallel_for(std::size_t(0), drawing.tiles.count(), [&](std::size_t tile) {
        work.check();
        paint_tile(tiles.local(), drawing, int(tile) % drawing.tiles.x, int(tile) / drawing.tiles.x, out);
    });
    return out;
}

void expose(Picture& below, const Grid<float>& emission, const Glow& glow, const Work& work) {
    const Extent e = emission.extent();
    const auto long_side = float(e.long_side());
    std::vector<Halo> halos;
    std::vector<Channels> gains;
    for (const Glow::Halo& halo : glow.halos) {
        halos.emplace_back(emission, halo.sigma * long_side);
        gains.push_back(channels(halo.colour));
        for (float& gain : gains.back()) gain *= halo.gain * glow.exposure;
        work.check();
    }
    if (glow.cast > 0) halos.emplace_back(emission, glow.cast_sigma * long_side);
    Channels core = channels(glow.core);
    for (float& gain : core) gain *= glow.core_gain * glow.exposure;
    const std::array<float, 256> log_transmission = log_transmission_table();

    tbb::parallel_for(0, e.y, [&](int y) {
        std::vector<float> halo_row(std::size_t(e.x), 0.0f);
        std::vector<float> below_gain(std::size_t(e.x), glow.ambient);
        std::vector<Channels> light(std::size_t(e.x));
        for (std::size_t x = 0; x < light.size(); ++x)
            for (std::size_t c = 0; c < 3; ++c) light[x][c] = core[c] * emission.row(y)[x];
        for (std::size_t h = 0; h < gains.size(); ++h) {
            halos[h].read_row(y, halo_row);
            for (std::size_t x = 0; x < light.size(); ++x)
                for (std::size_t c = 0; c < 3; ++c) light[x][c] += gains[h][c] * halo_row[x];
        }
        if (glow.cast > 0) {
            halos.back().read_row(y, halo_row);
            for (std::size_t x = 0; x < light.size(); ++x) below_gain[x] += glow.cast * halo_row[x];
        }
        for (std::size_t x = 0; x < light.size(); ++x)
            below.row(y)[x] = exposed(below.row(y)[x], light[x], below_gain[x], log_transmission);
    });
}

}  // namespace dstylize
