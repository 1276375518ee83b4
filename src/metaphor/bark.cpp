#include "metaphor/bark.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/noise.h"
#include "core/sampling.h"

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
        : subject_(subject),
          p_(parameters),
          u_(subject.u_px),
          wanted_(subject.field("wanted")),
          guided_(subject.field("guided")),
          noise_(subject.seed, Purpose::bark) {
        const float angle = p_.light_deg * 3.14159265f / 180;
        light_ = {std::cos(angle), std::sin(angle)};
    }

    void limb(VariableStroke stroke, Layer& layer) {
        ++limbs_;
        const float haze = stroke.layer > 0 ? 1 - std::pow(1 - p_.back_haze, float(stroke.layer)) : 0;
        lit_ = mixed(p_.lit, p_.haze, haze);
        shade_ = mixed(p_.shade, p_.haze, haze);
        if (stroke.layer > 0)
            for (float& width : stroke.width_px) width *= p_.back_width;
        const float widest = *std::max_element(stroke.width_px.begin(), stroke.width_px.end());
        VariableStroke outline = stroke;
        const float thick = smoothstep(0, p_.round_from * 2, widest / u_);
        const float tone = p_.twig_tone * toned(stroke.points_px[stroke.points_px.size() / 2]);
        outline.colour = mixed(mixed(lit_, shade_, std::clamp(p_.twig_shade + tone, 0.0f, 1.0f)), shade_, thick);
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
        out.colour = mixed(shade_, lit_, std::pow(inner, 0.8f));
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
                    out.colour = dark ? shade_ : mixed(lit_, {1, 0.96f, 0.88f, 1}, 0.25f);
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

    /// How much darker than its middle the picture wants it there, in [-1, 1].
    float toned(Vec2f at_px) const {
        const Vec2f node = at_px * (1 / subject_.px_per_node);
        return sample(guided_, node) * (2 * sample(wanted_, node) - 1);
    }

    float random() { return noise_.unit(std::uint64_t(limbs_) << 24 | ++draws_); }

    const Subject& subject_;
    const BarkParameters& p_;
    const float u_;
    const Grid<float>&wanted_, &guided_;
    Rgba lit_, shade_;  // of the present limb's layer
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
    v.number({"twig_tone", "", "how much lighter twigs are where the picture is light"}, twig_tone, 0, 1);
    v.colour({"haze", "", "colour of what stands far behind"}, haze);
    v.number({"back_haze", "", "share of haze in the layer behind, more in those farther back"}, back_haze, 0, 1);
    v.number({"back_width", "", "widths behind, as a share of those in front"}, back_width, 0.1f, 1);
}

std::vector<Layer> bark_layers(const Subject& subject, const BarkParameters& parameters) {
    const auto& strokes = subject.strokes;
    std::vector<float> widest(strokes.size());
    for (std::size_t s = 0; s < strokes.size(); ++s)
        widest[s] = *std::max_element(strokes[s].width_px.begin(), strokes[s].width_px.end());
    std::vector<std::uint32_t> order(strokes.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto rank = [&](std::uint32_t s) { return std::pair(-int(strokes[s].layer), widest[s]); };
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return rank(a) < rank(b); });
    std::vector<Layer> layers;
    Painter painter(subject, parameters);
    int layer = -1;
    for (const std::uint32_t s : order) {
        if (strokes[s].layer != layer) {
            layer = strokes[s].layer;
            layers.push_back({layer == 0 ? "branches" : "branches behind", Blend::over, {}});
        }
        painter.limb(strokes[s], layers.back());
    }
    return layers;
}

}  // namespace dstylize
