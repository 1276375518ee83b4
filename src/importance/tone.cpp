// Fields of brightness: what is dark, and how much ink it wants.
#include <algorithm>
#include <cmath>

#include "core/vec.h"
#include "imaging/filters.h"
#include "importance/detail_field_functions.h"

namespace dstylize::field {
namespace {

/// Mixed with the ranks of its samples.
void equalise(Grid<float>& tone, float share) {
    const Grid<float> ranks = rank(tone);
    each_index(tone.size(), [&](std::size_t n) { tone[n] = (1 - share) * tone[n] + share * ranks[n]; });
}

/// tone - share * its wide blur, stretched to [0, 1] again.
void take_away_surroundings(Grid<float>& tone, float share, float sigma) {
    const Grid<float> around = blurred(tone, sigma);
    each_index(tone.size(), [&](std::size_t n) { tone[n] -= share * around[n]; });
    const auto [lo, hi] = percentiles(tone, 5, 98);
    // A picture of one colour has nothing to stretch.
    if (hi - lo < 1e-4f) {
        each_index(tone.size(), [&](std::size_t n) { tone[n] += share * around[n]; });
        return;
    }
    transform(tone, [lo = lo, hi = hi](float v) { return std::clamp((v - lo) / (hi - lo), 0.0f, 1.0f); });
}

}  // namespace

Grid<float> luma(Fields& fields) { return fields.source_luma(); }

Grid<float> lightness(Fields& fields) {
    const Grid<float>& source = fields.source_luma();
    const auto [lo, hi] = percentiles(source, fields.parameters().stretch_low, fields.parameters().stretch_high);
    // A picture of one colour has nothing to stretch.
    if (hi - lo < 1e-4f) return source;
    return transformed(source, [lo = lo, hi = hi](float v) { return std::clamp((v - lo) / (hi - lo), 0.0f, 1.0f); });
}

Grid<float> darkness(Fields& fields) {
    return transformed(fields["lightness"], [](float v) { return 1 - v; });
}

Grid<float> tone(Fields& fields) {
    const FieldParameters& p = fields.parameters();
    const auto drawn = [&p](float lightness) { return p.bright ? lightness : 1 - lightness; };
    // Paper stays really white and blacks become really black; otherwise mid-grey photos stay grey.
    const auto clean = [&p](float v) {
        return std::clamp((v - p.tone_white) / (p.tone_black - p.tone_white), 0.0f, 1.0f);
    };
    Grid<float> out;
    if (p.tone_equalise > 0 || p.tone_local > 0) {
        out = transformed(fields["lightness"], drawn);
        if (p.tone_equalise > 0) equalise(out, p.tone_equalise);
        if (p.tone_local > 0) take_away_surroundings(out, p.tone_local, p.tone_local_scale * fields.u());
        transform(out, clean);
    } else {
        out = transformed(fields["lightness"], [&](float v) { return clean(drawn(v)); });
    }
    if (p.tone_contrast > 0)
        transform(out, [&](float v) { return v + p.tone_contrast * (smoothstep(0.08f, 0.82f, v) - v); });
    if (const auto& map = fields.maps().importance; map && !fields.maps().importance_replaces)
        each_index(out.size(), [&](std::size_t n) { out[n] *= (*map)[n]; });
    return out;
}

}  // namespace dstylize::field
