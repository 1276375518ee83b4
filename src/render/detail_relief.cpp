// Strokes as a body on the ground: the largest height of all rods at every pixel, lit from one side, with a
// shadow cast on the ground, contact shade around it, and a skin that shows the ground's own grain.
#include "render/detail_relief.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "core/noise.h"
#include "core/sampling.h"
#include "geometry/tapered_line.h"
#include "imaging/filters.h"

namespace dstylize {
namespace {

constexpr int kBand = 32;  // rows that one task paints
constexpr float kFlatness_px = 0.05f;

/// A piece of a stroke in output pixels.
struct Rod {
    Vec2f a, b;
    float radius_a = 0, radius_b = 0, tip_a = 0, tip_b = 0;
    std::uint32_t colour = 0;
};

/// Rods of all strokes, binned by the bands of rows that they touch.
class Rods {
  public:
    Rods(const DisplayList& list, const Layer& layer, Extent size, std::vector<Rgba>& palette)
        : scale_{float(size.x) / list.width_px, float(size.y) / list.height_px},
          bands(std::size_t((size.y + kBand - 1) / kBand)) {
        for (const Item& item : layer.items) {
            const auto* stroke = std::get_if<VariableStroke>(&item);
            if (!stroke || stroke->points_px.empty()) continue;
            auto known = std::find(palette.begin(), palette.end(), stroke->colour);
            if (known == palette.end()) known = palette.insert(known, stroke->colour);
            add(*stroke, layer.relief->tip_length_px, std::uint32_t(known - palette.begin()));
        }
    }

  private:
    Vec2f scale_;

  public:
    std::vector<std::vector<Rod>> bands;

  private:
    void add(const VariableStroke& stroke, float tip_length_px, std::uint32_t colour) {
        const float width_scale = std::sqrt(scale_.x * scale_.y);
        std::vector<Vec2f> points;
        std::vector<float> widths;
        for (std::size_t k = 0; k < stroke.points_px.size(); ++k) {
            points.push_back({stroke.points_px[k].x * scale_.x, stroke.points_px[k].y * scale_.y});
            widths.push_back(stroke.width_px[k] * width_scale);
        }
        const TaperedLine line = simplified(smooth_line(points, widths, kFlatness_px), kFlatness_px);
        if (line.empty()) return;
        const float decay = std::max(1e-3f, tip_length_px * width_scale);
        float to_end = 0, tip_b = 1;
        for (std::size_t k = line.size(); k-- > 0;) {
            const WidthPoint &b = line[k], &a = line[k > 0 ? k - 1 : 0];
            if (k == 0 && line.size() > 1) break;
            to_end += distance(a.at, b.at);
            const float tip_a = std::exp(-to_end / decay);
            bin({a.at, b.at, a.width / 2, b.width / 2, tip_a, tip_b, colour});
            tip_b = tip_a;
        }
    }
    void bin(const Rod& rod) {
        const float reach = std::max(rod.radius_a, rod.radius_b) + 1;
        const float top = (std::min(rod.a.y, rod.b.y) - reach) / kBand,
                    bottom = (std::max(rod.a.y, rod.b.y) + reach) / kBand;
        const auto most = float(bands.size() - 1);
        if (bottom < 0 || top > most + 1) return;
        for (auto band = std::size_t(std::clamp(top, 0.0f, most)); band <= std::size_t(std::clamp(bottom, 0.0f, most));
             ++band)
            bands[band].push_back(rod);
    }
};

void paint(const Rod& rod, int first_row, int last_row, Body& out) {
    const float reach = std::max(rod.radius_a, rod.radius_b) + 1;
    const int x0 = std::max(0, int(std::min(rod.a.x, rod.b.x) - reach));
    const int x1 = std::min(out.height.extent().x - 1, int(std::max(rod.a.x, rod.b.x) + reach));
    const int y0 = std::max(first_row, int(std::min(rod.a.y, rod.b.y) - reach));
    const int y1 = std::min(last_row, int(std::max(rod.a.y, rod.b.y) + reach));
    const Vec2f along = rod.b - rod.a;
    const float square = std::max(1e-9f, dot(along, along));
    for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) {
            const Vec2f p{float(x) + 0.5f, float(y) + 0.5f};
            const float t = std::clamp(dot(p - rod.a, along) / square, 0.0f, 1.0f);
            const float away = distance(p, lerp(rod.a, rod.b, t));
            const float radius = rod.radius_a + (rod.radius_b - rod.radius_a) * t;
            const float coverage = std::clamp(radius - away + 0.5f, 0.0f, 1.0f);
            if (coverage <= 0) continue;
            const float height = std::sqrt(std::max(0.0f, radius * radius - away * away));
            if (height > out.height(x, y) || (height == out.height(x, y) && coverage > out.coverage(x, y))) {
                out.height(x, y) = height;
                out.tip(x, y) = rod.tip_a + (rod.tip_b - rod.tip_a) * t;
                out.colour(x, y) = rod.colour;
            }
            out.coverage(x, y) = std::max(out.coverage(x, y), coverage);
        }
}

/// Smooth noise in [0, 1] with cells of that size, keyed by the drawing: every output size shows the same.
Grid<float> cloud(const DisplayList& list, float cell_px, std::uint64_t seed, std::uint32_t stream, Extent size) {
    const Extent cells{std::max(2, int(std::lround(list.width_px / cell_px))),
                       std::max(2, int(std::lround(list.height_px / cell_px)))};
    const Noise noise(seed, Purpose::relief, stream);
    Grid<float> coarse(cells);
    noise.units(0, coarse);
    return resized(coarse, size);
}

Rgba mix(Rgba a, Rgba b, float t) {
    return {a.r + (b.r - a.r) * t, a.g + (b.g - a.g) * t, a.b + (b.b - a.b) * t, a.a + (b.a - a.a) * t};
}
float unit(float v) { return std::clamp(v, 0.0f, 1.0f); }

/// How the ground's brightness at every pixel compares with that of its surroundings.
Grid<float> ground_grain(const Picture& below, float sigma_px) {
    Grid<float> luma = blurred(luma_plane(below), 0.06f * sigma_px);
    const Grid<float> around = blurred(luma, sigma_px);
    for (std::size_t n = 0; n < luma.size(); ++n)
        luma[n] = std::clamp((luma[n] + 0.03f) / (around[n] + 0.03f), 0.35f, 1.6f);
    return luma;
}

/// The surface that is lit: flattened rods, a rough skin, the ground's bumps showing through.
Grid<float> surface(const Body& body, const Relief& relief, const Grid<float>& rough, const Grid<float>& grain,
                    float scale) {
    const float flat = std::max(1e-3f, relief.radius_px * scale);
    Grid<float> out(body.height.extent());
    for (std::size_t n = 0; n < out.size(); ++n) {
        const float profile = std::pow(body.height[n] / flat, 0.8f);
        out[n] = flat * (relief.height * profile + body.coverage[n] * (relief.roughness * (rough[n] - 0.5f) +
                                                                       relief.drape * 0.5f * (grain[n] - 1)));
    }
    return blurred(out, std::max(0.4f, 0.16f * flat));
}

class Lighting {
  public:
    Lighting(const Picture& below, const Body& body, const DisplayList& list, const Relief& relief)
        : body_(body),
          relief_(relief),
          scale_(std::sqrt(float(below.extent().x) / list.width_px * float(below.extent().y) / list.height_px)),
          rough_(cloud(list, 0.55f * relief.radius_px, relief.seed, 0, below.extent())),
          patches_(cloud(list, 7 * relief.radius_px, relief.seed, 1, below.extent())),
          grain_(relief.drape > 0 ? ground_grain(below, relief.drape_sigma_px * scale_)
                                  : Grid<float>(below.extent(), 1)),
          surface_(surface(body, relief, rough_, grain_, scale_)),
          gaps_(blurred(body.coverage, relief.gap_sigma_px * scale_)),
          contact_(blurred(body.coverage, relief.contact_sigma_px * scale_)),
          shadow_(blurred(body.coverage, relief.shadow_sigma_px * scale_)) {
        const float length = std::sqrt(dot(relief.light, relief.light) + relief.light_height * relief.light_height);
        light_ = (1 / length) * relief.light;
        light_height_ = relief.light_height / length;
    }

    Rgba8 pixel(Rgba8 below, int x, int y) const {
        // Below, premultiplied, under the shadow; then the body between the strokes; then the strokes.
        const float alpha = float(below.a) / 255, shade = shadow(x, y);
        Rgba out{float(below.r) / 255 * alpha * (1 - shade), float(below.g) / 255 * alpha * (1 - shade),
                 float(below.b) / 255 * alpha * (1 - shade), alpha + (1 - alpha) * shade};
        const float lit = brightness(x, y), patch = patches_(x, y), fine = rough_(x, y);
        const float gap = relief_.gap * smoothstep(0.42f, 0.66f, gaps_(x, y) + 0.25f * (patch - 0.5f));
        if (gap > 0)
            lay(out, scaled(relief_.gap_colour, (0.62f + 0.5f * fine) * (1 - 0.4f * shade) * drape(x, y)), gap);
        if (body_.coverage(x, y) <= 0) return straight(out);
        const float tip = body_.tip(x, y);
        Rgba skin = mix(body_.palette[body_.colour(x, y)], relief_.tip, unit(1.15f * tip + 0.5f * (patch - 0.5f)));
        skin = mix(skin, relief_.gap_colour, unit(1.6f * (1 - tip) * (patch - 0.5f)));
        const float buried = 1 - relief_.contact * unit(1.3f * contact_(x, y) - 0.4f) * (1 - tip);
        lay(out, scaled(skin, lit * buried * drape(x, y)), body_.coverage(x, y));
        return straight(out);
    }

  private:
    static Rgba scaled(Rgba c, float k) { return {unit(c.r * k), unit(c.g * k), unit(c.b * k), c.a}; }
    static void lay(Rgba& under, Rgba c, float share) {
        const float a = unit(share) * c.a, rest = 1 - a;
        under = {c.r * a + under.r * rest, c.g * a + under.g * rest, c.b * a + under.b * rest, a + under.a * rest};
    }
    static Rgba8 straight(Rgba c) {
        const auto byte = [&](float v) { return std::uint8_t(unit(v / std::max(c.a, 1e-6f)) * 255 + 0.5f); };
        return {byte(c.r), byte(c.g), byte(c.b), std::uint8_t(unit(c.a) * 255 + 0.5f)};
    }

    float shadow(int x, int y) const {
        const Extent e = shadow_.extent();
        const Vec2f offset = (-relief_.shadow_length_px * scale_) * light_;
        const int sx = std::clamp(int(std::lround(float(x) - offset.x)), 0, e.x - 1);
        const int sy = std::clamp(int(std::lround(float(y) - offset.y)), 0, e.y - 1);
        return unit(relief_.shadow * shadow_(sx, sy) + 0.5f * relief_.contact * contact_(x, y));
    }
    float brightness(int x, int y) const {
        const Extent e = surface_.extent();
        const float dx = 0.5f * (surface_(std::min(x + 1, e.x - 1), y) - surface_(std::max(x - 1, 0), y));
        const float dy = 0.5f * (surface_(x, std::min(y + 1, e.y - 1)) - surface_(x, std::max(y - 1, 0)));
        const float lambert = (light_height_ - dx * light_.x - dy * light_.y) / std::sqrt(1 + dx * dx + dy * dy);
        return relief_.ambient + (1.06f - relief_.ambient) * std::max(0.0f, lambert) / light_height_;
    }
    float drape(int x, int y) const {
        return relief_.drape > 0 ? std::clamp(std::pow(grain_(x, y), relief_.drape), 0.35f, 1.25f) : 1.0f;
    }

    const Body& body_;
    const Relief& relief_;
    float scale_;
    Grid<float> rough_, patches_, grain_, surface_, gaps_, contact_, shadow_;
    Vec2f light_;
    float light_height_ = 1;
};

}  // namespace

Body body(const DisplayList& list, const Layer& layer, Extent size, const Work& work) {
    Body out{Grid<float>(size), Grid<float>(size), Grid<float>(size), Grid<std::uint32_t>(size), {}};
    const Rods rods(list, layer, size, out.palette);
    tbb::parallel_for(std::size_t(0), rods.bands.size(), [&](std::size_t band) {
        work.check();
        const int first = int(band) * kBand, last = std::min(size.y - 1, first + kBand - 1);
        for (const Rod& rod : rods.bands[band]) paint(rod, first, last, out);
    });
    return out;
}

void raise(Picture& below, const Body& body, const DisplayList& list, const Relief& relief, const Work& work) {
    if (body.palette.empty()) return;
    const Lighting lighting(below, body, list, relief);
    work.check();
    tbb::parallel_for(0, below.extent().y, [&](int y) {
        Rgba8* row = below.row(y);
        for (int x = 0; x < below.extent().x; ++x) row[x] = lighting.pixel(row[x], x, y);
    });
}

}  // namespace dstylize
