#include "metaphor/emission.h"

#include <algorithm>
#include <cmath>

#include "core/sampling.h"

namespace dstylize {
namespace {

/// Mean over +-reach neighbours, repeating the first and running into the dark past the tip.
std::vector<float> rolled(const std::vector<float>& values, int reach) {
    const int n = int(values.size());
    std::vector<double> sum(1, 0);
    for (const float v : values) sum.push_back(sum.back() + double(v));
    std::vector<float> out(values.size());
    for (int i = 0; i < n; ++i) {
        const int lo = std::max(0, i - reach), hi = std::min(n, i + reach + 1);
        const double before = double(std::max(0, reach - i)) * double(values.front());
        out[std::size_t(i)] = float((sum[std::size_t(hi)] - sum[std::size_t(lo)] + before) / double(2 * reach + 1));
    }
    return out;
}

/// Towards the tip a stroke dims, and it starts no brighter than its parent is there.
void fade(std::vector<float>& values, float at_tip) {
    constexpr float kOverParent = 1.02f, kGainPerPoint = 0.02f;
    const float first = values.front();
    for (std::size_t k = 1; k < values.size(); ++k) {
        const float t = float(k) / float(values.size());
        values[k] = std::min(values[k] * (1 - at_tip * t * t), first * kOverParent + kGainPerPoint * float(k));
    }
}

}  // namespace

void EmissionParameters::visit(ParameterVisitor& v) {
    v.number({"shine", "", "least brightness of a stroke"}, least, 0, 1);
    v.number({"shine_tone", "", "brightness added where the picture's tone is full"}, tone, 0, 2);
    v.number({"shine_tone_gamma", "", "above 1 keeps mid-tones dim"}, tone_gamma, 0.3f, 4);
    v.number({"shine_lines", "", "brightness added on thin lines"}, lines, 0, 2);
    v.number({"shine_limbs", "", "brightness added where a stroke carries all tips: few blazing bolts, many hairs"},
             limbs, 0, 4);
    v.number({"shine_limbs_exponent", "", "share of tips to this power: lower brightens more of the limbs"},
             limbs_exponent, 0.1f, 2);
    v.number({"shine_fade", "", "how much of a stroke's brightness is gone at its tip"}, fade, 0, 1);
    v.number({"shine_window", "u", "half length of the rolling mean of brightness"}, window, 0, 100);
}

std::vector<std::vector<float>> emission(const Subject& subject, const EmissionParameters& p) {
    constexpr float kLeastOfOwn = 0.35f;  // a short bright place keeps this much of its own
    const Grid<float>&tone = subject.field("tone"), &lines = subject.field("lines");
    std::vector<std::vector<float>> out(subject.strokes.size());
    for (std::size_t s = 0; s < out.size(); ++s) {
        const std::vector<Vec2f>& points = subject.strokes[s].points_px;
        std::vector<float> own(points.size());
        for (std::size_t k = 0; k < points.size(); ++k) {
            const Vec2f at = points[k] * (1 / subject.px_per_node);
            own[k] = std::min(1.0f, p.least + p.tone * std::pow(sample(tone, at), p.tone_gamma) +
                                        p.lines * sample(lines, at) +
                                        p.limbs * std::pow(subject.tip_share[s][k], p.limbs_exponent));
        }
        const auto reach = int(std::lround(p.window * subject.u_px / subject.px_per_node));
        out[s] = rolled(own, reach);
        for (std::size_t k = 0; k < own.size(); ++k) out[s][k] = std::max(out[s][k], kLeastOfOwn * own[k]);
        fade(out[s], p.fade);
    }
    return out;
}

}  // namespace dstylize
