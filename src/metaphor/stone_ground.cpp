#include "metaphor/stone_ground.h"

#include <tbb/parallel_for.h>
#include <algorithm>
#include <cmath>

#include "core/noise.h"

namespace dstylize {
namespace {

/// Value noise in [0, 1]: independent values on a grid, smoothly joined.
class ValueNoise {
  public:
    ValueNoise(std::uint64_t seed, std::uint32_t stream, Extent size_px, float cell_px)
        : cells_per_px_(std::min(1.0f, 1 / cell_px)),  // finer ones could not be seen
          turned_(0.6f * float(size_px.y + 2)),
          values_({int((turned_ + 0.8f * float(size_px.x + 2)) * cells_per_px_) + 2,
                   int((0.6f * float(size_px.x + 2) + 0.8f * float(size_px.y + 2)) * cells_per_px_) + 2}) {
        const Noise noise(seed, Purpose::paper, stream);
        tbb::parallel_for(0, values_.extent().y, [&](int j) {
            const std::uint64_t row = std::uint64_t(j) << 32;
            float* value = values_.row(j);
            for (int i = 0; i < values_.extent().x; i += 4) {
                const auto random = noise.block(row + std::uint64_t(i));
                for (int k = 0; k < 4 && i + k < values_.extent().x; ++k)
                    value[i + k] = Noise::unit_of(random[std::size_t(k)]);
            }
        });
    }
    float operator()(int x, int y) const {
        // Two grids, one turned: the mean shows no axes.
        return 0.5f * at(float(x), float(y)) +
               0.5f * at(turned_ + 0.8f * float(x) - 0.6f * float(y), 0.6f * float(x) + 0.8f * float(y));
    }

  private:
    float at(float x, float y) const {
        const float u = x * cells_per_px_, v = y * cells_per_px_;
        const int i = int(u), j = int(v);
        const auto smooth = [](float share) { return share * share * (3 - 2 * share); };
        const float fx = smooth(u - float(i)), fy = smooth(v - float(j));
        const float *above = values_.row(j) + i, *below = values_.row(j + 1) + i;
        const float top = above[0] + (above[1] - above[0]) * fx;
        const float bottom = below[0] + (below[1] - below[0]) * fx;
        return top + (bottom - top) * fy;
    }

    float cells_per_px_, turned_;
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
        for (int x = 0; x < size.x; ++x) (*out)(x, y) = stone.colour(x, y, height(x + 1, y + 1) - height(x, y));
    });
    return out;
}

}  // namespace dstylize
