#include "render/detail_grain.h"

#include <array>
#include <cmath>

namespace dstylize {
namespace {

constexpr int kCell = 8;
constexpr float kFineShare = 0.8f, kCoarseShare = 0.6f;  // squares sum to 1
/// Standard deviation of the 256 levels of a byte about their mean, in units of the byte.
const float kByteDeviation = std::sqrt((256.0f * 256.0f - 1) / 12);
/// What the blurs leave of a white noise's deviation: sums of squared weights, 3/8 per axis for the binomial
/// filter and 11/20 per axis, on average over a cell, for the quadratic B-spline.
constexpr float kBinomialDeviation = 3.0f / 8, kSplineDeviation = 11.0f / 20;

float centred(std::uint32_t byte) { return float(byte & 255u) - 127.5f; }

/// One draw serves four neighbours of a row. Coordinates may be -1: the counter wraps, which is fine.
std::uint64_t counter(int x, int y) { return std::uint64_t(std::uint32_t(y)) << 32 | std::uint32_t(x); }

/// Quadratic B-spline weights of three knots at offset t in [0, 1) of the middle one's cell.
std::array<float, 3> spline_weights(float t) { return {0.5f * (1 - t) * (1 - t), 0.5f + t * (1 - t), 0.5f * t * t}; }

}  // namespace

const std::vector<float>& Grain::block(int x0, int y0, int width, int height) {
    values_.assign(std::size_t(width) * std::size_t(height), 0.0f);
    add_fine(x0, y0, width, height);
    add_coarse(x0, y0, width, height);
    return values_;
}

void Grain::add_fine(int x0, int y0, int width, int height) {
    // One more pixel on each side for the blur, widened to whole groups of four.
    const int first = ((x0 - 1) >> 2) * 4, last = ((x0 + width) >> 2) * 4 + 4, stride = last - first;
    white_.resize(std::size_t(stride) * 3);
    auto draw = [&](int y) {
        float* row = white_.data() + std::size_t((y + 3) % 3) * std::size_t(stride);
        for (int x = first; x < last; x += 4) {
            const std::uint32_t bits = fine_.bits(counter(x >> 2, y));
            for (int k = 0; k < 4; ++k) row[x - first + k] = centred(bits >> (8 * k));
        }
    };
    const float scale = kFineShare / (16 * kByteDeviation * kBinomialDeviation);
    draw(y0 - 1);
    draw(y0);
    for (int y = y0; y < y0 + height; ++y) {
        draw(y + 1);
        const float* above = white_.data() + std::size_t((y + 2) % 3) * std::size_t(stride);
        const float* here = white_.data() + std::size_t((y + 3) % 3) * std::size_t(stride);
        const float* below = white_.data() + std::size_t((y + 4) % 3) * std::size_t(stride);
        float* out = values_.data() + std::size_t(y - y0) * std::size_t(width);
        for (int i = 0; i < width; ++i) {
            const int x = x0 - first + i;
            auto column = [&](int c) { return above[c] + 2 * here[c] + below[c]; };
            out[i] += scale * (column(x - 1) + 2 * column(x) + column(x + 1));
        }
    }
}

void Grain::add_coarse(int x0, int y0, int width, int height) {
    const int column0 = x0 / kCell - 1, columns = (x0 + width - 1) / kCell + 2 - column0;
    const int row0 = y0 / kCell - 1, rows = (y0 + height - 1) / kCell + 2 - row0;
    // Each row of knots, already interpolated along x.
    lattice_.resize(std::size_t(rows) * std::size_t(width));
    std::vector<float> knots(std::size_t(columns), 0.0f);
    const float scale = kCoarseShare / (kByteDeviation * kSplineDeviation);
    for (int r = 0; r < rows; ++r) {
        for (int c = 0; c < columns; ++c)
            knots[std::size_t(c)] = scale * centred(coarse_.bits(counter(column0 + c, row0 + r)));
        for (int i = 0; i < width; ++i) {
            const int x = x0 + i, c = x / kCell - column0;
            const auto w = spline_weights((float(x % kCell) + 0.5f) / kCell);
            lattice_[std::size_t(r) * std::size_t(width) + std::size_t(i)] =
                w[0] * knots[std::size_t(c - 1)] + w[1] * knots[std::size_t(c)] + w[2] * knots[std::size_t(c + 1)];
        }
    }
    for (int j = 0; j < height; ++j) {
        const int y = y0 + j, r = y / kCell - row0;
        const auto w = spline_weights((float(y % kCell) + 0.5f) / kCell);
        const float* above = lattice_.data() + std::size_t(r - 1) * std::size_t(width);
        float* out = values_.data() + std::size_t(j) * std::size_t(width);
        for (int i = 0; i < width; ++i)
            out[i] += w[0] * above[i] + w[1] * above[i + width] + w[2] * above[i + 2 * width];
    }
}

}  // namespace dstylize
