#include "metaphor/stone_ground.h"

#include <algorithm>
#include <cmath>
#include <tbb/parallel_for.h>

#include "core/noise.h"

namespace dstylize {
namespace {

/// Value noise in [0, 1]: independent values on a grid, smoothly joined.
class ValueNoise {
  public:
    ValueNoise(std::uint64_t seed, std::uint32_t stream, Extent size_px, float cell_px)
        : cell_px_(cell_px),
          turned_(0.6f * float(size_px.y + 2)),
          values_({int((turned_ + 0.8f * float(size_px.x + 2)) / cell_px) + 2,
                   int((0.6f * float(size_px.x + 2) + 0.8f * float(size_px.y + 2)) / cell_px) + 2}) {
        const Noise noise(seed, Purpose::paper, stream);
        const auto stride = std::size_t(int(float(size_px.x + size_px.y + 4) / cell_px) + 2);
        tbb::parallel_for(0, values_.extent().y, [&](int j) {
            for (int i = 0; i < values_.extent().x; ++i)
                values_(i, j) = noise.unit(std::size_t(j) * stride + std::size_t(i));
        });
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

/// The noises of which the stone is made; `size_px` and `cell_px` of the picture of it.
struct Stone {
    Stone(std::uint64_t seed, Extent size_px, float cell_px)
        : clouds(seed, 16, size_px, 210 * cell_px),
          stains(seed, 17, size_px, 90 * cell_px),
          bumps(seed, 18, size_px, 14 * cell_px),
          grains(seed, 19, size_px, 5 * cell_px),
          fine(seed, 20, size_px, 2 * cell_px),
          pits(seed, 21, size_px, 9 * cell_px),
          flecks(seed, 22, size_px, 3.2f * cell_px) {}

    float height(int x, int y) const {
        return 1.3f * bumps(x, y) + 0.9f * grains(x, y) - 1.5f * smoothstep(0.62f, 0.85f, pits(x, y));
    }
    Rgba8 colour(int x, int y, float slope) const {
        const float warm = clouds(x, y) - 0.5f;
        float light = 0.27f + 0.07f * (stains(x, y) - 0.5f) + 0.10f * (fine(x, y) - 0.5f) + 0.055f * slope;
        light += 0.16f * smoothstep(0.80f, 0.92f, flecks(x, y)) - 0.07f * smoothstep(0.60f, 0.85f, pits(x, y));
        const auto byte = [](float v) { return std::uint8_t(std::clamp(v, 0.0f, 1.0f) * 255 + 0.5f); };
        return {byte(light * (1.02f + 0.12f * warm)), byte(light), byte(light * (1 - 0.12f * warm)), 255};
    }

    ValueNoise clouds, stains, bumps, grains, fine, pits, flecks;
};

}  // namespace

std::shared_ptr<const Picture> basalt(const Subject& subject) {
    constexpr float kMostSide = 1600, kCellsPerSide = 1600;
    const float scale = std::min(1.0f, kMostSide / std::max(subject.width_px, subject.height_px));
    const Extent size{std::max(1, int(subject.width_px * scale)), std::max(1, int(subject.height_px * scale))};
    const Stone stone(subject.seed, size, float(size.long_side()) / kCellsPerSide);
    Grid<float> height({size.x + 1, size.y + 1});
    tbb::parallel_for(0, size.y + 1, [&](int y) {
        for (int x = 0; x <= size.x; ++x) height(x, y) = stone.height(x, y);
    });
    auto out = std::make_shared<Picture>(size);
    tbb::parallel_for(0, size.y, [&](int y) {
        for (int x = 0; x < size.x; ++x)
            (*out)(x, y) = stone.colour(x, y, height(x + 1, y + 1) - height(x, y));
    });
    return out;
}

}  // namespace dstylize
