// Noise fields. They live on a grid fixed to the picture, finer than most lattices, and every lattice
// samples that one grid: half the detail is then an honest preview of the full one.
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "imaging/filters.h"
#include "importance/detail_field_functions.h"
#include "importance/fractal_noise.h"

namespace dstylize::field {

Grid<float> white_noise(Fields& fields) {
    constexpr float kCellsPer_u = 2;
    const Noise noise(fields.seed(), Purpose::white_noise);
    const Extent e = fields.extent();
    const float per_node = kCellsPer_u / fields.u();
    const auto cell = [per_node](int node) { return std::uint64_t((float(node) + 0.5f) * per_node); };
    std::vector<std::uint64_t> column;
    for (int i = 0; i < e.x; ++i) column.push_back(cell(i));
    Grid<float> out = Grid<float>::unset(e);
    // Where nodes are finer than cells, several have the same one.
    tbb::parallel_for(tbb::blocked_range<int>(0, e.y), [&](const tbb::blocked_range<int>& rows) {
        for (int j = rows.begin(); j < rows.end(); ++j) {
            float* const row = out.row(j);
            if (j > rows.begin() && cell(j) == cell(j - 1)) {
                std::copy_n(out.row(j - 1), e.x, row);
                continue;
            }
            for (std::size_t i = 0; i < column.size(); ++i)
                row[i] = i > 0 && column[i] == column[i - 1] ? row[i - 1] : noise.unit(cell(j) << 32 | column[i]);
        }
    });
    return out;
}

namespace {
/// Where a node lies among coarse cells: so far from one to the next.
struct Between {
    int cell;
    float share;
};
}  // namespace

Grid<float> correlated_noise(const Fields& fields, Purpose purpose, float cell_u, float sigma_u,
                             std::uint32_t substream) {
    const Noise noise(fields.seed(), purpose, substream);
    const Extent e = fields.extent();
    const float nodes_per_cell = cell_u * fields.u();
    const Extent cells{int(std::ceil(float(e.x) / nodes_per_cell)) + 1,
                       int(std::ceil(float(e.y) / nodes_per_cell)) + 1};
    Grid<float> coarse(cells);
    tbb::parallel_for(0, cells.y, [&](int j) {
        const std::span row(coarse.row(j), std::size_t(cells.x));
        noise.units(std::uint64_t(j) << 32, row);
        for (float& v : row) v -= 0.5f;
    });
    coarse = blurred(coarse, sigma_u / cell_u);
    // The blur of independent samples of variance 1/12 by a Gaussian has variance 1 / (12 * 4 pi sigma^2).
    const float deviation = std::sqrt(1 / (12 * 4 * 3.14159265f)) / (sigma_u / cell_u);
    const auto between = [nodes_per_cell](int node, int cell_count) {
        const float x = (float(node) + 0.5f) / nodes_per_cell;
        const int cell = std::min(int(x), cell_count - 2);
        return Between{cell, x - float(cell)};
    };
    std::vector<Between> column;
    for (int i = 0; i < e.x; ++i) column.push_back(between(i, cells.x));
    Grid<float> out = Grid<float>::unset(e);
    tbb::parallel_for(0, e.y, [&](int j) {
        std::vector<float> row(std::size_t(cells.x));
        const Between at = between(j, cells.y);
        for (int c = 0; c < cells.x; ++c)
            row[std::size_t(c)] = (coarse(c, at.cell) * (1 - at.share) + coarse(c, at.cell + 1) * at.share) / deviation;
        for (int i = 0; i < e.x; ++i) {
            const auto [cell, share] = column[std::size_t(i)];
            out(i, j) = row[std::size_t(cell)] * (1 - share) + row[std::size_t(cell) + 1] * share;
        }
    });
    return out;
}

Grid<float> smooth_noise(Fields& fields) {
    const float sigma_u = fields.parameters().smooth_noise_scale;
    Grid<float> out = correlated_noise(fields, Purpose::smooth_noise, sigma_u / 3, sigma_u);
    transform(out, [](float v) { return std::clamp(0.5f + v / 4, 0.0f, 1.0f); });
    return out;
}

}  // namespace dstylize::field

namespace dstylize {

Grid<float> fractal_noise(const Fields& fields, float wavelength_u, std::uint32_t substream) {
    // A Gaussian of sigma 0.3 wavelengths correlates like value noise; deviations 4 : 2 : 1 and 0.14 in all
    // make the spread of three octaves of it.
    constexpr float kSigma = 0.3f, kDeviation = 0.14f, kNorm = 4.5826f;
    Grid<float> out(fields.extent(), 0.5f);
    float sigma = kSigma * wavelength_u, share = 4;
    for (std::uint32_t octave = 0; octave < 3; ++octave, sigma /= 2, share /= 2) {
        const Grid<float> noise =
            field::correlated_noise(fields, Purpose::smooth_noise, sigma / 2, sigma, 1 + 3 * substream + octave);
        each_index(out.size(), [&](std::size_t n) { out[n] += kDeviation * share / kNorm * noise[n]; });
    }
    transform(out, [](float v) { return std::clamp(v, 0.0f, 1.0f); });
    return out;
}

}  // namespace dstylize
