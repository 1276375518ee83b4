// Fields of a shape: the user's mask, or without one the dark parts of the picture. What grows in a letter
// is led by its medial axis, seeks its outline, and is no wider than it has room.
#include <algorithm>
#include <cmath>

#include "imaging/bands.h"
#include "imaging/skeleton.h"
#include "importance/detail_field_functions.h"

namespace dstylize::field {
namespace {

constexpr float kHalf = 0.5f;

Grid<std::uint8_t> bare_shape(Fields& fields) {
    const std::optional<Grid<float>>& mask = fields.maps().mask;
    const Grid<float>& source = mask ? *mask : fields["darkness"];
    Grid<std::uint8_t> out(source.extent());
    std::transform(source.begin(), source.end(), out.begin(), [](float v) { return std::uint8_t(v >= kHalf); });
    return out;
}

/// Whether a neighbour belongs to a part of a higher number.
bool meets_another_part(const Grid<int>& part, const Grid<std::uint8_t>& inside, int i, int j) {
    const Extent e = part.extent();
    for (int y = std::max(0, j - 1); y <= std::min(e.y - 1, j + 1); ++y)
        for (int x = std::max(0, i - 1); x <= std::min(e.x - 1, i + 1); ++x)
            if (inside(x, y) && part(x, y) > part(i, j)) return true;
    return false;
}

/// Keeps what is joined to the axis without leaving the shape.
Grid<std::uint8_t> joined_to(const Grid<std::uint8_t>& axis, const Grid<std::uint8_t>& inside) {
    const Extent e = inside.extent();
    Grid<std::uint8_t> out = axis;
    std::vector<std::pair<int, int>> open;
    for (int j = 0; j < e.y; ++j)
        for (int i = 0; i < e.x; ++i)
            if (axis(i, j)) open.emplace_back(i, j);
    while (!open.empty()) {
        const auto [i, j] = open.back();
        open.pop_back();
        for (int y = std::max(0, j - 1); y <= std::min(e.y - 1, j + 1); ++y)
            for (int x = std::max(0, i - 1); x <= std::min(e.x - 1, i + 1); ++x)
                if (inside(x, y) && !out(x, y)) {
                    out(x, y) = 1;
                    open.emplace_back(x, y);
                }
    }
    return out;
}

}  // namespace

Grid<std::uint8_t> shape_axis(Fields& fields) { return skeleton(bare_shape(fields)); }

Grid<std::uint8_t> shape_interior(Fields& fields) {
    const FieldParameters& p = fields.parameters();
    Grid<std::uint8_t> bare = bare_shape(fields);
    if (p.shape_overflow <= 0 && p.shape_ragged <= 0) return bare;
    const float u = fields.u();
    const Grid<float> depth = signed_depth(bare);
    const Grid<std::uint8_t>& axis = fields.shape_axis();
    const Grid<int> part = nearest_part(bare);
    const float scale_u = std::max(0.5f, p.shape_ragged_scale);
    const Grid<float> noise = correlated_noise(fields, Purpose::ragged_outline, scale_u / 3, scale_u);
    Grid<std::uint8_t> grown(bare.extent());
    each_index(grown.size(), [&](std::size_t n) {
        const float share = std::clamp(kHalf + noise[n] / 3, 0.0f, 1.0f);
        grown[n] = axis[n] || depth[n] >= (p.shape_ragged * share - p.shape_overflow) * u;
    });
    // Where two parts would grow into one, a gap of one node stays between them.
    Grid<std::uint8_t> parted = grown;
    for (int j = 0; j < grown.extent().y; ++j)
        for (int i = 0; i < grown.extent().x; ++i)
            if (grown(i, j) && !axis(i, j) && meets_another_part(part, grown, i, j)) parted(i, j) = 0;
    return joined_to(axis, parted);
}

Grid<float> shape(Fields& fields) {
    const Grid<std::uint8_t>& interior = fields.shape_interior();
    Grid<float> out(interior.extent());
    std::copy(interior.begin(), interior.end(), out.begin());
    return out;
}

Grid<float> axis(Fields& fields) {
    const Grid<float> away = distance_to(fields.shape_axis());
    const float sigma = std::max(0.1f, fields.parameters().axis_width * fields.u());
    Grid<float> out(away.extent());
    std::transform(away.begin(), away.end(), out.begin(),
                   [sigma](float s) { return std::exp(-s * s / (2 * sigma * sigma)); });
    return out;
}

Grid<float> rim(Fields& fields) {
    const Grid<float> depth = signed_depth(fields.shape_interior());
    const float width = std::max(1.0f, fields.parameters().rim_width * fields.u());
    Grid<float> out(depth.extent());
    std::transform(depth.begin(), depth.end(), out.begin(),
                   [width](float d) { return d < 0 ? 0.0f : std::max(0.0f, 1 - 0.5f * d / width); });
    return out;
}

Grid<float> room(Fields& fields) {
    const Grid<float> depth = signed_depth(bare_shape(fields)), to_axis = distance_to(fields.shape_axis());
    const float whole = kRoom_u * fields.u();
    Grid<float> out(depth.extent());
    each_index(out.size(), [&](std::size_t n) {
        out[n] = std::clamp((std::max(0.0f, depth[n]) + to_axis[n]) / whole, 0.0f, 1.0f);
    });
    return out;
}

}  // namespace dstylize::field
