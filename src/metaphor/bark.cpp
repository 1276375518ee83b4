#include "metaphor/bark.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/noise.h"

namespace dstylize {
namespace {

Rgba mixed(Rgba a, Rgba b, float t) {
    return {a.r + (b.r - a.r) * t, a.g + (b.g - a.g) * t, a.b + (b.b - a.b) * t, a.a + (b.a - a.a) * t};
}

/// Unit direction along the stroke at a point.
Vec2f along(const VariableStroke& stroke, std::size_t k) {
    const auto& p = stroke.points_px;
    return normalized(p[std::min(k + 1, p.size() - 1)] - p[k > 0 ? k - 1 : 0]);
}

/// Paints limbs one after the other into one layer.
class Painter {
  public:
    Painter(const Subject& subject, const BarkParameters& parameters)
        : p_(parameters), u_(subject.u_px), noise_(subject.seed, Purpose::bark) {
        const float angle = p_.light_deg * 3.14159265f / 180;
        light_ = {std::cos(angle), std::sin(angle)};
    }

    void limb(const VariableStroke& stroke, Layer& layer) {
        ++limbs_;
        const float widest = *std::max_element(stroke.width_px.begin(), stroke.width_px.end());
        VariableStroke outline = stroke;
        const float thick = smoothstep(0, p_.round_from * 2, widest / u_);
        outline.colour = mixed(mixed(p_.lit, p_.shade, p_.twig_shade), p_.shade, thick);
        layer.items.emplace_back(std::move(outline));
        if (widest < p_.round_from * u_) return;
        const int bands = std::clamp(int(widest / (1.6f * u_)) + 1, 2, 8);
        for (int k = 1; k <= bands; ++k) band(stroke, float(k) / float(bands + 1), layer);
        if (p_.furrows > 0 && widest > p_.furrow_from * u_) furrows(stroke, layer);
    }

  private:
    /// A stroke inside the limb, `inner` of the way from its outline to the line that faces the light. On a
    /// cylinder that line lies where the normal meets the light; brightness falls to both sides of it.
    void band(const VariableStroke& limb, float inner, Layer& layer) const {
        constexpr float kTowardsViewer = 0.67f;
        VariableStroke out;
        out.order = limb.order;
        out.stage = limb.stage;
        out.colour = mixed(p_.shade, p_.lit, std::pow(inner, 0.8f));
        for (std::size_t k = 0; k < limb.points_px.size(); ++k) {
            const float width = limb.width_px[k],
                        shaded = smoothstep(0.6f * p_.round_from, 1.6f * p_.round_from, width / u_);
            if (shaded <= 0) {
                if (out.points_px.size() > 1) layer.items.emplace_back(out);
                out.points_px.clear();
                out.width_px.clear();
                continue;
            }
            const Vec2f across = perpendicular(along(limb, k));
            const float lateral = 0.74f * dot(across, light_);
            const float facing = lateral / std::sqrt(lateral * lateral + kTowardsViewer * kTowardsViewer);
            out.points_px.push_back(limb.points_px[k] + across * (facing * inner * width / 2));
            out.width_px.push_back(width * (1 - inner) * shaded * 0.98f);
        }
        if (out.points_px.size() > 1) layer.items.emplace_back(std::move(out));
    }

    /// Dark lines at fixed angles around the limb, that wander, break off and start again.
    void furrows(const VariableStroke& limb, Layer& layer) {
        const float widest = *std::max_element(limb.width_px.begin(), limb.width_px.end());
        const int lines = std::clamp(int(widest / (1.7f * u_)), 2, 18);
        for (int line = 0; line < lines; ++line) {
            const float around = (float(line) + 0.2f + 0.6f * random()) / float(lines);  // 0 … 1 across
            float run = 40 * u_ * random(), wander = 0;
            bool draws = random() < 0.5f;
            VariableStroke out;
            const auto finish = [&] {
                if (out.points_px.size() > 3) {
                    out.width_px.front() = out.width_px.back() = 0.1f * u_;
                    layer.items.emplace_back(out);
                }
                out.points_px.clear();
                out.width_px.clear();
            };
            for (std::size_t k = 1; k < limb.points_px.size(); ++k) {
                const float width = limb.width_px[k];
                run -= distance(limb.points_px[k], limb.points_px[k - 1]);
                if (width < p_.furrow_from * u_) break;
                if (run <= 0) {
                    finish();
                    draws = !draws;
                    run = (draws ? 14 + 40 * random() : 5 + 22 * random()) * u_;
                    const bool dark = random() < 0.72f;
                    out.colour = dark ? p_.shade : mixed(p_.lit, {1, 0.96f, 0.88f, 1}, 0.25f);
                    out.colour.a = p_.furrows * (dark ? 0.75f : 0.4f);
                }
                if (!draws) continue;
                wander = 0.9f * wander + 0.12f * (random() - 0.5f);
                const float side = std::sin(std::clamp(around + wander / 3, 0.02f, 0.98f) * 3.14159265f - 1.57079633f);
                out.points_px.push_back(limb.points_px[k] + perpendicular(along(limb, k)) * (0.93f * side * width / 2));
                const float foreshortened = std::sqrt(std::max(0.1f, 1 - side * side));
                out.width_px.push_back(std::clamp(0.055f * width, 0.55f * u_, 1.5f * u_) * foreshortened);
            }
            finish();
        }
    }

    float random() { return noise_.unit(std::uint64_t(limbs_) << 24 | ++draws_); }

    const BarkParameters& p_;
    const float u_;
    Noise noise_;
    Vec2f light_;
    std::uint32_t limbs_ = 0, draws_ = 0;
};

}  // namespace

void BarkParameters::visit(ParameterVisitor& v) {
    v.colour({"lit", "", "colour of bark in the light"}, lit);
    v.colour({"shade", "", "colour of bark in the shade"}, shade);
    v.number({"light_deg", "deg", "where light comes from: 0 right, 90 below, 180 left, 270 above"}, light_deg, 0, 360);
    v.number({"round_from", "u", "limbs wider than this are shaded as round"}, round_from, 0.5f, 50);
    v.number({"furrows", "", "opacity of the bark's furrows"}, furrows, 0, 1);
    v.number({"furrow_from", "u", "limbs wider than this have furrows"}, furrow_from, 1, 100);
    v.number({"twig_shade", "", "how dark the thinnest twigs are"}, twig_shade, 0, 1);
}

Layer bark_layer(const Subject& subject, const BarkParameters& parameters) {
    const auto& strokes = subject.strokes;
    std::vector<float> widest(strokes.size());
    for (std::size_t s = 0; s < strokes.size(); ++s)
        widest[s] = *std::max_element(strokes[s].width_px.begin(), strokes[s].width_px.end());
    std::vector<std::uint32_t> order(strokes.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return widest[a] < widest[b]; });
    Layer layer{"branches", Blend::over, {}};
    layer.items.reserve(strokes.size());
    Painter painter(subject, parameters);
    for (const std::uint32_t s : order) painter.limb(strokes[s], layer);
    return layer;
}

}  // namespace dstylize
