// Fields of composition: where a drawing keeps to, how far the picture leads there, and the ink that is
// wanted in the end: the picture's on one side, a random one on the other (Long & Mould 2009, s. 5.2).
#include <algorithm>
#include <array>
#include <cmath>

#include "imaging/filters.h"
#include "importance/detail_field_functions.h"
#include "importance/fractal_noise.h"

namespace dstylize {

void CrownParameters::visit(ParameterVisitor& v) {
    v.flag({"shaped", "", "keep to an oval crown instead of the whole frame"}, shaped);
    v.number({"x", "", "where its middle lies, as a share of the frame's width"}, x, 0, 1);
    v.number({"y", "", "the same of the height"}, y, 0, 1);
    v.number({"width", "", "its width as a share of the frame's"}, width, 0.05f, 2);
    v.number({"height", "", "its height as a share of the frame's"}, height, 0.05f, 2);
    v.number({"power", "", "2 is an ellipse, more is squarer"}, power, 1, 8);
    v.number({"lobes", "", "how far its outline swings in and out"}, lobes, 0, 0.5f);
    v.number({"soft", "", "share of its radius over which it fades out"}, soft, 0.01f, 0.9f);
    v.number({"likeness", "", "0 a plausible tree, 1 the picture"}, likeness, 0, 1);
    v.number({"free_side", "", "share of the width, from the left, that is left to chance"}, free_side, 0, 1);
    v.number({"free_ramp", "", "share of the width over which the picture takes the lead"}, free_ramp, 0.01f, 1);
    v.number({"free_tone", "", "ink where chance leads"}, free_tone, 0, 1);
    v.number({"free_scale", "u", "size of its denser and thinner parts"}, free_scale, 5, 400);
}

}  // namespace dstylize

namespace dstylize::field {
namespace {

/// The outline's radius as a share of the oval's: waves of two to nine lobes.
class Lobes {
  public:
    Lobes(float amount, Noise noise) : amount_(amount) {
        for (std::size_t k = 0; k < kWaves; ++k) phase_[k] = 6.2831853f * noise.unit(k);
    }
    float operator()(float angle) const {
        float sum = 0;
        for (std::size_t k = 0; k < kWaves; ++k)
            sum += std::sin(float(k + 2) * angle + phase_[k]) / std::sqrt(float(k + 2));
        return 1 + amount_ * sum / 1.5f;
    }

  private:
    static constexpr std::size_t kWaves = 8;
    float amount_;
    std::array<float, kWaves> phase_;
};

}  // namespace

Grid<float> crown(Fields& fields) {
    const CrownParameters& p = fields.parameters().crown;
    const Extent e = fields.extent();
    Grid<float> out(e, 1.0f);
    if (!p.shaped) return out;
    const Lobes lobes(p.lobes, Noise(fields.seed(), Purpose::jitter, 1));
    const Grid<float> ragged = fractal_noise(fields, 40, 900);
    for (int j = 0; j < e.y; ++j)
        for (int i = 0; i < e.x; ++i) {
            const float x = ((float(i) + 0.5f) / float(e.x) - p.x) / (p.width / 2);
            const float y = ((float(j) + 0.5f) / float(e.y) - p.y) / (p.height / 2);
            const float oval = std::pow(std::pow(std::abs(x), p.power) + std::pow(std::abs(y), p.power), 1 / p.power);
            const float out_of = oval / lobes(std::atan2(y, x)) + 0.2f * (ragged(i, j) - 0.5f);
            out(i, j) = 1 - smoothstep(1 - p.soft, 1, out_of);
        }
    return out;
}

Grid<float> guided(Fields& fields) {
    const CrownParameters& p = fields.parameters().crown;
    Grid<float> out = fields["crown"];
    const float likeness = fields.maps().no_picture ? 0 : p.likeness;
    const Extent e = fields.extent();
    std::vector<float> leads(std::size_t(e.x), likeness);
    for (int i = 0; i < e.x && p.free_side > 0; ++i) {
        const float x = (float(i) + 0.5f) / float(e.x);
        leads[std::size_t(i)] *= smoothstep(p.free_side - p.free_ramp / 2, p.free_side + p.free_ramp / 2, x);
    }
    each_index(std::size_t(e.y), [&](std::size_t j) {
        float* const row = out.row(int(j));
        for (std::size_t i = 0; i < leads.size(); ++i) row[i] = leads[i] * smoothstep(0, 0.6f, row[i]);
    });
    return out;
}

Grid<float> guide(Fields& fields) {
    Grid<float> out = fields["importance"];
    const Grid<float>& leads = fields["guided"];
    each_index(out.size(), [&](std::size_t n) { out[n] *= leads[n]; });
    return out;
}

Grid<float> wanted(Fields& fields) {
    const CrownParameters& p = fields.parameters().crown;
    Grid<float> out = fields["tone"];
    if (!p.shaped && p.free_side <= 0 && p.likeness >= 1 && !fields.maps().no_picture) return out;
    const Grid<float>&inside = fields["crown"], &leads = fields["guided"];
    const Grid<float> chance = fractal_noise(fields, p.free_scale, 901);
    each_index(out.size(), [&](std::size_t n) {
        const float random = p.free_tone * std::max(0.0f, 0.3f + 1.4f * (0.5f + 2 * (chance[n] - 0.5f)));
        out[n] = std::clamp(inside[n] * (leads[n] * out[n] + (1 - leads[n]) * random), 0.0f, 1.0f);
    });
    return out;
}

Grid<float> lacking(Fields& fields) {
    Grid<float> out = fields["wanted"];
    transform(out, [](float v) { return std::min(1.0f, 2 * v); });
    return out;
}

}  // namespace dstylize::field
