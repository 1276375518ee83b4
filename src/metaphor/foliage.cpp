#include "metaphor/foliage.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/noise.h"
#include "core/sampling.h"

namespace dstylize {
namespace {

/// A leaf from its stalk at `base`, pointed at both ends, a little bent.
Fill leaf(Vec2f base, Vec2f direction, float length, float aspect, float bend, Rgba colour) {
    constexpr std::array<float, 5> kAt{0.18f, 0.4f, 0.6f, 0.8f, 0.93f}, kHalfWidth{0.55f, 0.98f, 0.96f, 0.6f, 0.25f};
    const Vec2f side = perpendicular(direction);
    const auto spine = [&](float t) { return base + direction * (t * length) + side * (bend * length * t * t); };
    Fill out{{}, colour};
    out.outline_px.push_back(base);
    for (std::size_t k = 0; k < kAt.size(); ++k)
        out.outline_px.push_back(spine(kAt[k]) + side * (kHalfWidth[k] * aspect * length / 2));
    out.outline_px.push_back(spine(1));
    for (std::size_t k = kAt.size(); k-- > 0;)
        out.outline_px.push_back(spine(kAt[k]) - side * (kHalfWidth[k] * aspect * length / 2));
    return out;
}

float unit(std::uint32_t bits) { return float(bits >> 8) * 0x1p-24f; }

}  // namespace

void FoliageParameters::visit(ParameterVisitor& v) {
    v.number({"foliage", "", "leaves per leaf length of twig; 0 leaves the tree bare"}, foliage, 0, 4);
    v.number({"leaf_size", "u", "length of a leaf"}, leaf_size, 1, 60);
    v.number({"leaf_aspect", "", "its width as a share of its length"}, leaf_aspect, 0.1f, 1);
    v.number({"leaf_twig", "u", "twigs thinner than this bear leaves"}, leaf_twig, 0.2f, 20);
    v.colour({"leaf_light", "", "colour of leaves where the picture is light"}, leaf_light);
    v.colour({"leaf_dark", "", "colour of leaves where it is dark"}, leaf_dark);
    v.number({"leaf_likeness", "", "how far the picture says which leaves are dark"}, leaf_likeness, 0, 1);
    v.number({"leaf_variety", "", "how much leaves differ by chance"}, leaf_variety, 0, 1);
}

Layer foliage_layer(const Subject& subject, const FoliageParameters& p) {
    Layer layer{"leaves", Blend::over, {}};
    const Grid<float>&tone = subject.field("tone"), &inside = subject.field("crown");
    const Noise noise(subject.seed, Purpose::leaves, 1);
    const float u = subject.u_px, gap = p.leaf_size * u / std::max(0.01f, p.foliage);
    std::uint64_t count = 0;
    for (const VariableStroke& twig : subject.strokes) {
        float way = gap * unit(noise.bits(1u << 31 | count));
        for (std::size_t k = 1; k < twig.points_px.size(); ++k) {
            const Vec2f step = twig.points_px[k] - twig.points_px[k - 1];
            way -= length(step);
            const bool tip = k + 1 == twig.points_px.size();
            if (twig.width_px[k] > p.leaf_twig * u || (way > 0 && !tip)) continue;
            way = gap;
            const auto random = noise.block(++count), more = noise.block(count | std::uint64_t{1} << 40);
            const float turn = (count % 2 ? 1.0f : -1.0f) * (tip ? 0.5f : 1.2f) * (0.3f + unit(random[0]));
            const Vec2f along = normalized(step);
            const Vec2f direction = along * std::cos(turn) + perpendicular(along) * std::sin(turn);
            const Vec2f node = twig.points_px[k] * (1 / subject.px_per_node);
            const float leads = p.leaf_likeness * smoothstep(0.2f, 0.7f, sample(inside, node));
            const float chance = p.leaf_variety * (unit(random[1]) + unit(more[2]) - 1);
            const float dark = std::clamp(leads * sample(tone, node) + (1 - leads) * 0.45f + chance, 0.0f, 1.0f);
            Rgba colour = p.leaf_light;
            colour.r += (p.leaf_dark.r - colour.r) * dark;
            colour.g += (p.leaf_dark.g - colour.g) * dark + 0.12f * p.leaf_variety * (unit(more[1]) - 0.5f);
            colour.b += (p.leaf_dark.b - colour.b) * dark;
            colour.g = std::clamp(colour.g, 0.0f, 1.0f);
            const float size = p.leaf_size * u * (0.75f + 0.5f * unit(random[2]));
            layer.items.emplace_back(
                leaf(twig.points_px[k], direction, size, p.leaf_aspect, 0.3f * (unit(random[3]) - 0.5f), colour));
        }
    }
    return layer;
}

}  // namespace dstylize
