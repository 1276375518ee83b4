#include "pipeline/scene_ground.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/noise.h"
#include "core/sampling.h"
#include "imaging/filters.h"
#include "render/raster.h"

namespace dstylize {
namespace {

/// What shadow leaves of the light, per channel: the sky still lights it, and the sky is blue.
constexpr std::array<float, 3> kShadowLight{0.20f, 0.23f, 0.30f};

/// Coverage of a drawing without its paper, ever more blurred.
class Silhouette {
  public:
    Silhouette(const DisplayList& drawing, float soft_u, const Work& work) {
        constexpr int kLongSide = 768;
        const float scale = float(kLongSide) / std::max(drawing.width_px, drawing.height_px);
        const auto side = [scale](float px) { return std::max(1, int(std::lround(px * scale))); };
        DisplayList alone{drawing.width_px, drawing.height_px, {{1, 1, 1, 0}}, {}};
        for (const Layer& layer : drawing.layers)
            if (!layer.of_ground) alone.layers.push_back(layer);
        px_per_list_ = scale;
        const Grid<float> sharp = alpha_plane(raster(alone, {{side(drawing.width_px), side(drawing.height_px)}}, work));
        const float u = float(kLongSide) / 1024;
        for (const float share : {0.15f, 0.5f, 1.0f, 2.0f})
            levels_.push_back(blurred(sharp, std::max(0.3f, soft_u * u * share)));
    }

    /// `far` in [0, 1]: how far from the ground it is.
    float at(Vec2f p_list, float far) const {
        const float level = std::clamp(far, 0.0f, 1.0f) * float(levels_.size() - 1);
        const std::size_t lower = std::min(std::size_t(level), levels_.size() - 2);
        const float share = level - float(lower);
        return (1 - share) * sample(levels_[lower], p_list) + share * sample(levels_[lower + 1], p_list);
    }

  private:
    float sample(const Grid<float>& plane, Vec2f p_list) const {
        const Vec2f p = p_list * px_per_list_ - Vec2f{0.5f, 0.5f};
        const int x = int(std::floor(p.x)), y = int(std::floor(p.y));
        const auto value = [&](int i, int j) { return plane.extent().contains(i, j) ? plane(i, j) : 0.0f; };
        const float fx = p.x - float(x), fy = p.y - float(y);
        return (1 - fy) * ((1 - fx) * value(x, y) + fx * value(x + 1, y)) +
               fy * ((1 - fx) * value(x, y + 1) + fx * value(x + 1, y + 1));
    }

    float px_per_list_ = 1;
    std::vector<Grid<float>> levels_;
};

void darken(Rgba8& p, float dark) {
    const auto channel = [dark](std::uint8_t c, float left) {
        return std::uint8_t(float(c) * (1 - dark * (1 - left)) + 0.5f);
    };
    p = {channel(p.r, kShadowLight[0]), channel(p.g, kShadowLight[1]), channel(p.b, kShadowLight[2]), p.a};
}

/// The widest foot carries the silhouette.
const Foot& main_foot(const std::vector<Foot>& feet) {
    return *std::max_element(feet.begin(), feet.end(),
                             [](const Foot& a, const Foot& b) { return a.width_px < b.width_px; });
}

float contact_at(Vec2f p, const std::vector<Foot>& feet) {
    float dark = 0;
    for (const Foot& foot : feet) {
        const float w = std::max(foot.width_px, 1.0f);
        const float x = (p.x - foot.at_px.x) / (1.5f * w), y = (p.y - foot.at_px.y) / (0.45f * w);
        dark = std::max(dark, std::exp(-x * x - y * y));
    }
    return dark;
}

/// Mean colours of the darkest and the lightest tenth of a part of a picture, and the median of its luma.
struct Range {
    Rgba shadow, light;
    float middle;
};
Range range(const Picture& ground, Vec2f corner, Vec2f size) {
    const auto x0 = std::clamp(int(corner.x), 0, ground.extent().x - 1),
               y0 = std::clamp(int(corner.y), 0, ground.extent().y - 1);
    const auto x1 = std::clamp(int(corner.x + size.x), x0 + 1, ground.extent().x);
    const auto y1 = std::clamp(int(corner.y + size.y), y0 + 1, ground.extent().y);
    std::vector<std::pair<int, Rgba8>> by_luma;
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) {
            const Rgba8 p = ground(x, y);
            by_luma.emplace_back(299 * p.r + 587 * p.g + 114 * p.b, p);
        }
    std::stable_sort(by_luma.begin(), by_luma.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    const std::size_t tenth = std::max<std::size_t>(1, by_luma.size() / 10);
    const auto mean = [&](std::size_t first) {
        double r = 0, g = 0, b = 0;
        for (std::size_t n = first; n < first + tenth; ++n)
            r += by_luma[n].second.r, g += by_luma[n].second.g, b += by_luma[n].second.b;
        const double whole = 255.0 * double(tenth);
        return Rgba{float(r / whole), float(g / whole), float(b / whole), 1};
    };
    return {mean(0), mean(by_luma.size() - tenth), float(by_luma[by_luma.size() / 2].first) / 255'000};
}

/// The outline of blades before one foot: how far each column of the ground reaches up.
void raise_blades(std::vector<float>& heights, float x_px, float width_px, float blades, const Noise& noise,
                  std::uint64_t foot) {
    constexpr int kBlades = 90;
    constexpr float kReach = 2.4f;  // to both sides, in widths of the foot
    for (int k = 0; k < kBlades; ++k) {
        const auto random = noise.block(foot * kBlades + std::uint64_t(k));
        const auto unit = [&](std::size_t n) { return Noise::unit_of(random[n]); };
        const float t = 2 * unit(0) - 1;
        const float tall = blades * width_px * (0.10f + 0.38f * unit(1)) * std::exp(-3 * t * t);
        const float half = width_px * (0.035f + 0.05f * unit(2));
        const float middle = x_px + t * kReach * width_px, lean = (unit(3) - 0.5f) * 1.4f * half;
        const int first = std::max(0, int(middle - half)),
                  last = std::min(int(heights.size()) - 1, int(middle + half) + 1);
        for (int x = first; x <= last; ++x) {
            const float off = float(x) + 0.5f - middle;
            const float side = off < lean ? (off + half) / (lean + half) : (half - off) / (half - lean);
            heights[std::size_t(x)] = std::max(heights[std::size_t(x)], tall * std::clamp(side, 0.0f, 1.0f));
        }
    }
}

}  // namespace

void shade_ground(Picture& ground, float px_per_list, const DisplayList& drawing, const std::vector<Foot>& feet,
                  const Placement& placement, const SceneParameters& p, const Work& work) {
    if (p.shadow <= 0 && p.contact <= 0) return;
    const Silhouette silhouette(drawing, p.shadow_soft, work);
    const Vec2f foot = main_foot(feet).at_px;
    const float slope = std::abs(p.shadow_y) < 0.01f ? 0.01f : p.shadow_y;
    for (int y = 0; y < ground.extent().y; ++y)
        for (int x = 0; x < ground.extent().x; ++x) {
            const Vec2f in_scene{(float(x) + 0.5f) / px_per_list, (float(y) + 0.5f) / px_per_list};
            const Vec2f at = (in_scene - placement.shift_px) * (1 / placement.scale);
            float light = 1 - p.contact * contact_at(at, feet);
            const float height = (at.y - foot.y) / slope;  // of what throws its shadow here
            if (height >= 0 && height <= foot.y) {
                const float far = height / std::max(foot.y, 1.0f);
                light *= 1 - p.shadow * (1 - 0.35f * far) *
                                 silhouette.at({at.x - p.shadow_x * height, foot.y - height}, far);
            }
            if (light < 1) darken(ground(x, y), 1 - light);
        }
}

Picture foreground(const Picture& ground, float px_per_list, const DisplayList& drawing, const std::vector<Foot>& feet,
                   const Placement& placement, float blades, std::uint64_t seed) {
    const Noise noise(seed, Purpose::foreground);
    std::vector<float> heights(std::size_t(ground.extent().x));
    const float k = placement.scale * px_per_list;
    for (std::size_t f = 0; f < feet.size(); ++f)
        raise_blades(heights, placement.placed(feet[f].at_px).x * px_per_list, feet[f].width_px * k, blades, noise, f);
    const float level = placement.placed(feet[0].at_px).y * px_per_list;
    const float left = placement.shift_px.x * px_per_list, right = left + drawing.width_px * k;
    Picture out(ground.extent(), {0, 0, 0, 0});
    for (int y = 0; y < ground.extent().y; ++y)
        for (int x = std::max(0, int(left)); x < std::min(ground.extent().x, int(right) + 1); ++x) {
            const float edge = level - heights[std::size_t(x)];
            const float a = std::clamp(float(y) + 1 - edge, 0.0f, 1.0f);
            if (a <= 0) continue;
            out(x, y) = ground(x, y);
            out(x, y).a = std::uint8_t(float(out(x, y).a) * a + 0.5f);
        }
    return out;
}

void fade_light(DisplayList& placed, Vec2f drawing, const Placement& placement, float fade) {
    const Vec2f low = placement.shift_px, high = placement.placed(drawing);
    const float wide = fade * std::min(high.x - low.x, high.y - low.y);
    if (wide <= 0) return;
    // An edge that is the ground's own needs no fading.
    const float near = 0.02f * std::max(placed.width_px, placed.height_px);
    const auto share = [&](Vec2f p) {
        float inside = wide;
        if (low.x > near) inside = std::min(inside, p.x - low.x);
        if (low.y > near) inside = std::min(inside, p.y - low.y);
        if (high.x < placed.width_px - near) inside = std::min(inside, high.x - p.x);
        if (high.y < placed.height_px - near) inside = std::min(inside, high.y - p.y);
        return smoothstep(0, wide, inside);
    };
    for (Layer& layer : placed.layers) {
        if (!layer.glow) continue;
        for (Item& item : layer.items) {
            auto* stroke = std::get_if<VariableStroke>(&item);
            if (!stroke) continue;
            stroke->emission.resize(stroke->points_px.size(), 1.0f);
            for (std::size_t k = 0; k < stroke->points_px.size(); ++k)
                stroke->emission[k] *= share(stroke->points_px[k]);
        }
    }
}

void match_colours(DisplayList& placed, const Picture& ground, float px_per_list, const Box& box,
                   const SceneParameters& p) {
    constexpr float kAround = 0.15f;  // of the box, on every side
    const Vec2f margin = box.size_px * kAround;
    const Range to = range(ground, (box.corner_px - margin) * px_per_list, (box.size_px + 2 * margin) * px_per_list);
    // On white paper the same ink stands out more than before a dark background.
    const float dim = 1 - p.backlight * (1 - to.middle);
    const auto matched = [&](float c, float shadow, float light) {
        return dim * (c + p.match * (shadow + c * (light - shadow) - c));
    };
    for (Layer& layer : placed.layers) {
        if (layer.glow) continue;
        for (Item& item : layer.items) {
            Rgba& c = std::visit([](auto& it) -> Rgba& { return it.colour; }, item);
            const auto* stroke = std::get_if<VariableStroke>(&item);
            if (layer.of_ground && stroke && !stroke->points_px.empty()) {
                const Vec2f foot = stroke->points_px[0] * px_per_list;
                const Rgba8 g = ground(std::clamp(int(foot.x), 0, ground.extent().x - 1),
                                       std::clamp(int(foot.y), 0, ground.extent().y - 1));
                const float light = 0.75f + luma(c);
                const auto lit = [light](std::uint8_t v) { return std::min(1.0f, float(v) / 255 * light); };
                c = {lit(g.r), lit(g.g), lit(g.b), c.a};
                continue;
            }
            c = {matched(c.r, to.shadow.r, to.light.r), matched(c.g, to.shadow.g, to.light.g),
                 matched(c.b, to.shadow.b, to.light.b), c.a};
        }
    }
}

}  // namespace dstylize
