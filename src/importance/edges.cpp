// Fields of structure: gradients, line centres, and what combines them.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "imaging/filters.h"
#include "importance/detail_field_functions.h"

namespace dstylize::field {
namespace {

/// Divides by the given percentile and clips to [0, 1]; a field without contrast becomes 0.
void normalise(Grid<float>& field, float percent) {
    const float top = percentile(field, percent);
    transform(field, [=](float v) { return top > 1e-6f ? std::clamp(v / top, 0.0f, 1.0f) : 0.0f; });
}

Grid<float> normalised_gradient(Fields& fields, float scale_u) {
    Grid<float> g = gradient_magnitude(blurred(fields["lightness"], scale_u * fields.u()));
    normalise(g, fields.parameters().gradient_percentile);
    return g;
}

/// The user's importance map: multiplied in, or put in the place of the field.
void apply_user_map(Fields& fields, Grid<float>& field) {
    const UserMaps& maps = fields.maps();
    if (!maps.importance) return;
    each_index(field.size(), [&](std::size_t n) {
        field[n] = maps.importance_replaces ? (*maps.importance)[n] : field[n] * (*maps.importance)[n];
    });
}

/// Nothing important lies at the frame: otherwise long strokes run along it.
void fade_at_border(Fields& fields, Grid<float>& field) {
    const Grid<float> at_border = border(fields);  // quicker made than kept
    each_index(field.size(), [&](std::size_t n) { field[n] *= 1 - at_border[n]; });
}

}  // namespace

Grid<float> gradient(Fields& fields) {
    const FieldParameters& p = fields.parameters();
    Grid<float> out = normalised_gradient(fields, p.gradient_scale);
    if (p.gradient_wide_share > 0) {
        const Grid<float> wide = normalised_gradient(fields, p.gradient_wide_scale);
        each_index(out.size(), [&](std::size_t n) { out[n] = std::max(out[n], p.gradient_wide_share * wide[n]); });
    }
    if (p.gradient_gamma != 1) transform(out, [&](float v) { return std::pow(v, p.gradient_gamma); });
    if (p.gradient_tone > 0) {
        const Grid<float> tone = blurred(fields["tone"], 0.8f * fields.u());
        each_index(out.size(),
                   [&](std::size_t n) { out[n] *= 1 - p.gradient_tone * (1 - smoothstep(0.15f, 0.75f, tone[n])); });
        normalise(out, p.gradient_percentile);
    }
    return out;
}

Grid<float> lines(Fields& fields) {
    constexpr float kSurround = 3.5f;  // difference of Gaussians of sigmas 1 : 3.5
    const float sigma = fields.parameters().line_scale * fields.u();
    Grid<float> out = blurred(fields["tone"], sigma);
    const Grid<float> around = blurred(fields["tone"], sigma * kSurround);
    each_index(out.size(), [&](std::size_t n) { out[n] = std::max(0.0f, out[n] - around[n]); });
    normalise(out, 98);
    transform(out, [](float v) { return std::pow(v, 0.8f); });
    return out;
}

Grid<float> importance(Fields& fields) {
    const FieldParameters& p = fields.parameters();
    const float total = std::max(1e-6f, p.importance_gradient + p.importance_tone + p.importance_lines);
    Grid<float> out = transformed(fields["gradient"], [&](float v) { return v * p.importance_gradient / total; });
    const auto add = [&](std::string_view name, float weight) {
        if (weight == 0) return;
        const Grid<float>& field = fields[name];
        each_index(out.size(), [&](std::size_t n) { out[n] += field[n] * weight / total; });
    };
    add("tone", p.importance_tone);
    add("lines", p.importance_lines);
    if (p.importance_percentile < 100) normalise(out, p.importance_percentile);
    fade_at_border(fields, out);
    apply_user_map(fields, out);
    return out;
}

Grid<float> texture(Fields& fields) {
    const FieldParameters& p = fields.parameters();
    Grid<float> both = fields["gradient"];
    const Grid<float>& line = fields["lines"];
    each_index(both.size(), [&](std::size_t n) { both[n] = std::max(p.features_gradient * both[n], line[n]); });
    return blurred(both, p.features_surround * fields.u());
}

Grid<float> features(Fields& fields) {
    constexpr float kTolerated = 0.12f;  // surroundings this busy do not suppress yet
    const FieldParameters& p = fields.parameters();
    Grid<float> out = fields["gradient"];
    const Grid<float>& line = fields["lines"];
    each_index(out.size(), [&](std::size_t n) { out[n] = std::max(p.features_gradient * out[n], line[n]); });
    fade_at_border(fields, out);
    if (p.features_suppress > 0) {
        const Grid<float> around = blurred(out, p.features_surround * fields.u());
        each_index(out.size(), [&](std::size_t n) {
            out[n] = std::max(0.0f, out[n] - p.features_suppress * std::max(0.0f, around[n] - kTolerated));
        });
        normalise(out, 98.5f);
    }
    apply_user_map(fields, out);
    return out;
}

Grid<float> low_features(Fields& fields) {
    constexpr float kTop = 0.35f, kLow = 0.8f;  // shares of the height
    Grid<float> out = fields["features"];
    const Extent e = out.extent();
    for (int j = 0; j < e.y; ++j) {
        const float share = smoothstep(kTop, kLow, (float(j) + 0.5f) / float(e.y));
        for (int i = 0; i < e.x; ++i) out(i, j) *= share;
    }
    return out;
}

Grid<float> density(Fields& fields) {
    Grid<float> out = blurred(fields["tone"], 2 * fields.u());
    const Grid<float>&g = fields["gradient"], &line = fields["lines"];
    each_index(out.size(), [&](std::size_t n) {
        out[n] = 1 - (1 - 0.8f * out[n]) * (1 - 0.6f * std::max(0.75f * g[n], 0.9f * line[n]));
    });
    apply_user_map(fields, out);
    return out;
}

Grid<float> avoid(Fields& fields) {
    const FieldParameters& p = fields.parameters();
    Grid<float> out = blurred(fields["tone"], 0.8f * fields.u());
    transform(out, [](float v) { return 1 - v; });
    const Grid<float> around = blurred(out, p.avoid_scale * fields.u());
    each_index(out.size(), [&](std::size_t n) { out[n] = std::clamp(out[n] - p.avoid_level * around[n], 0.0f, 1.0f); });
    return out;
}

Grid<float> border(Fields& fields) {
    constexpr float kFullWithin_u = 3;
    const Extent e = fields.extent();
    const float inner = kFullWithin_u * fields.u(), outer = fields.parameters().border_width * fields.u();
    std::vector<float> at_distance;  // from the frame; further inside 0
    do at_distance.push_back(1 - smoothstep(inner, std::max(outer, inner + 1), float(at_distance.size())));
    while (at_distance.back() > 0);
    const int last = int(at_distance.size()) - 1;
    Grid<float> out = Grid<float>::unset(e);
    tbb::parallel_for(0, e.y, [&](int j) {
        const int from_row = std::min({j, e.y - 1 - j, last});
        float* const row = out.row(j);
        std::fill(row, row + e.x, at_distance[std::size_t(from_row)]);
        for (int i = 0; i < std::min(from_row, (e.x + 1) / 2); ++i)
            row[i] = row[e.x - 1 - i] = at_distance[std::size_t(i)];
    });
    return out;
}

Grid<float> calm(Fields& fields) {
    const FieldParameters& p = fields.parameters();
    Grid<float> detail = fields["gradient"];
    const Grid<float>& line = fields["lines"];
    each_index(detail.size(), [&](std::size_t n) { detail[n] = std::max(detail[n], line[n]); });
    fade_at_border(fields, detail);
    detail = blurred(detail, p.calm_scale * fields.u());
    const Grid<float> dark = blurred(fields["tone"], 8 * fields.u());
    each_index(detail.size(),
               [&](std::size_t n) { detail[n] = detail[n] < p.calm_detail && dark[n] < p.calm_tone ? 1.0f : 0.0f; });
    return detail;
}

}  // namespace dstylize::field
