// Layers of brush strokes, coarse to fine. Strokes are ordinary display list strokes and the renderer paints
// them, so that a brushed ground and a drawing have the same edges.
#include "pipeline/painter.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/display_list.h"
#include "core/noise.h"
#include "imaging/filters.h"
#include "render/raster.h"

namespace dstylize {
namespace {

constexpr float kBrushes_u[] = {26, 13, 7, 4};  // widths at full strength
constexpr float kLeastBrush_px = 2;
constexpr float kBlur = 0.35f;   // of the reference, in brush widths
constexpr float kStep = 0.5f;    // between strokes and along them, in brush widths
constexpr float kError = 0.03f;  // a smaller mean difference needs no stroke
constexpr int kMostSteps = 9, kLeastSteps = 3;
constexpr float kJitter = 0.035f;  // of a stroke's lightness

struct Planes {
    Grid<float> r, g, b;
    Rgba operator()(int x, int y) const { return {r(x, y), g(x, y), b(x, y), 1}; }
};

Planes planes(const Picture& picture, float sigma) {
    Planes out{Grid<float>(picture.extent()), Grid<float>(picture.extent()), Grid<float>(picture.extent())};
    for (std::size_t n = 0; n < picture.size(); ++n) {
        out.r[n] = float(picture[n].r) / 255;
        out.g[n] = float(picture[n].g) / 255;
        out.b[n] = float(picture[n].b) / 255;
    }
    if (sigma > 0.3f)
        for (Grid<float>* plane : {&out.r, &out.g, &out.b}) *plane = blurred(*plane, sigma);
    return out;
}

float difference(Rgba a, Rgba b) { return (std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b)) / 3; }

/// Unit vectors along the picture's structures: the smaller eigenvector of the smoothed structure tensor.
Grid<Vec2f> structure(const Picture& picture, float sigma) {
    const StructureTensor t = structure_tensor(derivatives(blurred(luma_plane(picture), 0.8f)));
    const Grid<float> xx = blurred(t.xx, sigma), xy = blurred(t.xy, sigma), yy = blurred(t.yy, sigma);
    Grid<Vec2f> out(picture.extent());
    for (std::size_t n = 0; n < out.size(); ++n) {
        const float across = 0.5f * std::atan2(2 * xy[n], xx[n] - yy[n]);
        out[n] = {-std::sin(across), std::cos(across)};
    }
    return out;
}

Rgba lightened(Rgba c, float by) {
    const auto channel = [by](float v) { return std::clamp(v + by, 0.0f, 1.0f); };
    return {channel(c.r), channel(c.g), channel(c.b), c.a};
}

/// One layer: strokes of one brush over a canvas.
class BrushLayer {
  public:
    BrushLayer(const Picture& picture, const Grid<Vec2f>& flow, float brush_px, std::uint64_t seed, int layer)
        : extent_(picture.extent()),
          flow_(flow),
          brush_px_(brush_px),
          wanted_(planes(picture, kBlur * brush_px)),
          noise_(seed, Purpose::brush, std::uint32_t(layer)) {}

    Picture painted(const Picture& canvas, bool everywhere, const Work& work) const {
        const Planes below = planes(canvas, 0);
        std::vector<Place> places = all_places(below, everywhere);
        std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
            return a.order != b.order ? a.order < b.order : a.index < b.index;
        });
        DisplayList list{float(extent_.x), float(extent_.y), {}, {{"brush", Blend::over, {}}}};
        list.paper.picture = std::make_shared<Picture>(canvas);
        for (const Place& place : places) add_stroke(list.layers[0].items, place, below);
        return raster(list, {extent_}, work);
    }

  private:
    struct Place {
        std::uint32_t order = 0;
        std::uint64_t index = 0;
        int x = 0, y = 0;
    };

    /// In every cell the pixel that differs most, where the cell as a whole differs.
    std::vector<Place> all_places(const Planes& below, bool everywhere) const {
        const int step = std::max(1, int(std::lround(kStep * 1.3f * brush_px_)));
        std::vector<Place> out;
        std::uint64_t cell = 0;
        for (int y0 = 0; y0 < extent_.y; y0 += step)
            for (int x0 = 0; x0 < extent_.x; x0 += step, ++cell) {
                const int x1 = std::min(x0 + step, extent_.x), y1 = std::min(y0 + step, extent_.y);
                float sum = 0, most = -1;
                Place place{noise_.bits(2 * cell), cell, x0, y0};
                for (int y = y0; y < y1; ++y)
                    for (int x = x0; x < x1; ++x) {
                        const float error = difference(wanted_(x, y), below(x, y));
                        sum += error;
                        if (error > most) most = error, place.x = x, place.y = y;
                    }
                if (everywhere || sum > kError * float((x1 - x0) * (y1 - y0))) out.push_back(place);
            }
        return out;
    }

    void add_stroke(std::vector<Item>& items, const Place& place, const Planes& below) const {
        const auto random = noise_.block(2 * place.index + 1);
        const auto unit = Noise::unit_of;
        const Rgba colour = wanted_(place.x, place.y);
        VariableStroke stroke;
        stroke.colour = lightened(colour, kJitter * (unit(random[0]) - 0.5f) * 2);
        Vec2f at{float(place.x) + 0.5f, float(place.y) + 0.5f}, way{};
        const int most = kLeastSteps + int(random[1] % unsigned(kMostSteps - kLeastSteps + 1));
        for (int k = 0; k <= most; ++k) {
            const int x = std::clamp(int(at.x), 0, extent_.x - 1), y = std::clamp(int(at.y), 0, extent_.y - 1);
            // A stroke ends where the canvas is nearer to the picture than its colour is.
            if (k > kLeastSteps && difference(wanted_(x, y), below(x, y)) < difference(wanted_(x, y), colour)) break;
            stroke.points_px.push_back(at);
            Vec2f along = flow_(x, y);
            if (k == 0 ? (random[2] & 1) != 0 : dot(along, way) < 0) along = along * -1.0f;
            way = k == 0 ? along : normalized(lerp(way, along, 0.6f));
            at = at + way * (brush_px_ * kStep);
        }
        const std::size_t last = stroke.points_px.size() - 1;
        for (std::size_t k = 0; k <= last; ++k)
            stroke.width_px.push_back(brush_px_ *
                                      (k == 0 ? 0.75f : 1 - 0.45f * float(k) / float(std::max<std::size_t>(last, 1))));
        const VariableStroke body = stroke;
        items.emplace_back(std::move(stroke));
        if (brush_px_ >= kBristledFrom_px) add_bristles(items, body, random);
    }

    /// Thin streaks along the stroke, lighter and darker: the ridges that bristles leave.
    void add_bristles(std::vector<Item>& items, const VariableStroke& body, std::array<std::uint32_t, 4> random) const {
        for (int k = 0; k < kBristles; ++k) {
            const auto byte = [&](int n) { return float(random[std::size_t(2 + n)] >> (8 * k) & 255) / 255; };
            const float aside = (float(k) + 0.2f + 0.6f * byte(0)) / float(kBristles) - 0.5f;
            VariableStroke streak;
            streak.colour = lightened(body.colour, kRidge * (k % 2 == 0 ? 1.0f : -1.0f) * (0.4f + 0.6f * byte(1)));
            streak.colour.a = 0.55f;
            for (std::size_t i = 0; i < body.points_px.size(); ++i) {
                const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, body.points_px.size() - 1);
                const Vec2f across = perpendicular(normalized(body.points_px[after] - body.points_px[before]));
                streak.points_px.push_back(body.points_px[i] + across * (aside * 0.8f * body.width_px[i]));
                streak.width_px.push_back(0.16f * body.width_px[i]);
            }
            items.emplace_back(std::move(streak));
        }
    }

    static constexpr int kBristles = 3;
    static constexpr float kBristledFrom_px = 5, kRidge = 0.05f;

    Extent extent_;
    const Grid<Vec2f>& flow_;
    float brush_px_;
    Planes wanted_;
    Noise noise_;
};

Picture mix(const Picture& a, const Picture& b, float share) {
    Picture out(a.extent());
    const auto channel = [share](int from, int to) {
        return std::uint8_t(float(from) + (float(to) - float(from)) * share + 0.5f);
    };
    for (std::size_t n = 0; n < a.size(); ++n)
        out[n] = {channel(a[n].r, b[n].r), channel(a[n].g, b[n].g), channel(a[n].b, b[n].b), a[n].a};
    return out;
}

}  // namespace

Picture brushed(const Picture& picture, float unit_px, float strength, std::uint64_t seed, const Work& work) {
    if (strength <= 0) return picture;
    const Grid<Vec2f> flow = structure(picture, 4 * unit_px);
    Picture opaque = picture;
    for (Rgba8& p : opaque) p.a = 255;
    Picture canvas = opaque;  // shows between the first strokes
    int layer = 0;
    for (const float brush_u : kBrushes_u) {
        const float brush_px = std::max(kLeastBrush_px, brush_u * unit_px * (0.35f + 0.65f * strength));
        canvas = BrushLayer(opaque, flow, brush_px, seed, layer).painted(canvas, layer == 0, work);
        ++layer;
    }
    return mix(picture, canvas, smoothstep(0, 0.4f, strength));
}

}  // namespace dstylize
