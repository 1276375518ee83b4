#include "metaphor/stone_ground.h"

#include <algorithm>
#include <cmath>

#include "core/noise.h"

namespace dstylize {
namespace {

/// Value noise in [0, 1]: independent values on a grid, smoothly joined.
class ValueNoise {
  public:
    ValueNoise(std::uint64_t seed, std::uint32_t stream, Extent size_px, float cell_px)
        : cell_px_(cell_px),
          turned_(0.6f * float(size_px.y + 2)),
          values_({int(float(size_px.x + size_px.y + 4) / cell_px) + 2,
                   int(float(size_px.x + size_px.y + 4) / cell_px) + 2}) {
        const Noise noise(seed, Purpose::paper, stream);
        for (std::size_t n = 0; n < values_.size(); ++n) values_[n] = noise.unit(n);
    }
    float operator()(int x, int y) const {
        // Two grids, one turned: the mean shows no axes.
        return 0.5f * at(float(x), float(y)) +
               0.5f * at(turned_ + 0.8f * float(x) - 0.6f * float(y), 0.6f * float(x) + 0.8f * float(y));
    }

  private:
    float at(float x, float y) const {
        const float u = x / cell_px_, v = y / cell_px_;
        const int i = int(u), j = int(v);
        const float fx = smoothstep(0, 1, u - float(i)), fy = smoothstep(0, 1, v - float(j));
        const float top = values_(i, j) + (values_(i + 1, j) - values_(i, j)) * fx;
        const float bottom = values_(i, j + 1) + (values_(i + 1, j + 1) - values_(i, j + 1)) * fx;
        return top + (bottom - top) * fy;
    }

    float cell_px_, turned_;
    Grid<float> values_;
};

}  // namespace

std::shared_ptr<const Picture> basalt(const Subject& subject) {
    constexpr float kMostSide = 1600, kCellsPerSide = 1600;
    const float scale = std::min(1.0f, kMostSide / std::max(subject.width_px, subject.height_px));
    const Extent size{std::max(1, int(subject.width_px * scale)), std::max(1, int(subject.height_px * scale))};
    const float cell = float(size.long_side()) / kCellsPerSide;
    const auto noise = [&](std::uint32_t stream, float cells) {
        return ValueNoise(subject.seed, 16 + stream, size, cells * cell);
    };
    const ValueNoise clouds = noise(0, 210), stains = noise(1, 90), bumps = noise(2, 14), grains = noise(3, 5),
                     fine = noise(4, 2), pits = noise(5, 9), flecks = noise(6, 3.2f);
    const auto height = [&](int x, int y) {
        return 1.3f * bumps(x, y) + 0.9f * grains(x, y) - 1.5f * smoothstep(0.62f, 0.85f, pits(x, y));
    };
    auto out = std::make_shared<Picture>(size);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const float slope = height(x + 1, y + 1) - height(x, y);
            const float warm = clouds(x, y) - 0.5f;
            float light = 0.27f + 0.07f * (stains(x, y) - 0.5f) + 0.10f * (fine(x, y) - 0.5f) + 0.055f * slope;
            light += 0.16f * smoothstep(0.80f, 0.92f, flecks(x, y)) - 0.07f * smoothstep(0.60f, 0.85f, pits(x, y));
            const auto byte = [](float v) { return std::uint8_t(std::clamp(v, 0.0f, 1.0f) * 255 + 0.5f); };
            (*out)(x, y) = {byte(light * (1.02f + 0.12f * warm)), byte(light), byte(light * (1 - 0.12f * warm)), 255};
        }
    return out;
}

}  // namespace dstylize
