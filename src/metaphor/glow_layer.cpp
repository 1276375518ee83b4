#include "metaphor/glow_layer.h"

#include <algorithm>
#include <cmath>

namespace dstylize {

void GlowParameters::visit(ParameterVisitor& v) {
    v.colour({"core", "", "colour of the strokes themselves"}, core);
    v.number({"core_gain", "", "light of the strokes themselves"}, core_gain, 0, 10);
    v.colour({"inner", "", "colour of the halo next to them"}, inner);
    v.number({"inner_gain", "", "light of the inner halo"}, inner_gain, 0, 20);
    v.number({"inner_radius", "u", "its blur"}, inner_radius, 0.2f, 100);
    v.colour({"middle", "", "colour of the halo around that"}, middle);
    v.number({"middle_gain", "", "light of the middle halo"}, middle_gain, 0, 20);
    v.number({"middle_radius", "u", "its blur"}, middle_radius, 0.2f, 200);
    v.colour({"outer", "", "colour of the bloom"}, outer);
    v.number({"outer_gain", "", "light of the bloom"}, outer_gain, 0, 20);
    v.number({"outer_radius", "u", "its blur"}, outer_radius, 0.2f, 400);
    v.number({"exposure", "", "k of the film 1 - exp(-k light)"}, exposure, 0.1f, 5);
    v.number({"ambient", "", "light of the ground away from the strokes"}, ambient, 0, 4);
    v.number({"cast", "", "light that strokes cast on the ground"}, cast, 0, 40);
    v.number({"cast_radius", "u", "how far they cast it"}, cast_radius, 1, 400);
    emission.visit(v);
}

Layer glow_layer(const Subject& subject, const GlowParameters& p) {
    constexpr float kSharePer_u = 1.0f / 1024;
    Layer layer{"light", Blend::max, {}, Glow{}};
    Glow& glow = *layer.glow;
    glow.core = p.core;
    glow.core_gain = p.core_gain;
    glow.halos = {{p.inner_radius * kSharePer_u, p.inner, p.inner_gain},
                  {p.middle_radius * kSharePer_u, p.middle, p.middle_gain},
                  {p.outer_radius * kSharePer_u, p.outer, p.outer_gain}};
    glow.exposure = p.exposure;
    glow.ambient = p.ambient;
    glow.cast = p.cast;
    glow.cast_sigma = p.cast_radius * kSharePer_u;
    std::vector<std::vector<float>> shine = emission(subject, p.emission);
    layer.items.reserve(subject.strokes.size());
    for (std::size_t s = 0; s < subject.strokes.size(); ++s) {
        VariableStroke stroke = subject.strokes[s];
        stroke.colour = p.core;
        stroke.emission = std::move(shine[s]);
        layer.items.push_back(std::move(stroke));
    }
    return layer;
}

Rgba8 exposed_ground(const Rgba& light, float exposure, std::uint8_t alpha) {
    const auto byte = [exposure](float v) {
        return std::uint8_t(255 * (1 - std::exp(-exposure * std::max(0.0f, v))) + 0.5f);
    };
    return {byte(light.r), byte(light.g), byte(light.b), alpha};
}

}  // namespace dstylize
