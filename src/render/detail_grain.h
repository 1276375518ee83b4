#pragma once
#include <cstdint>
#include <vector>

#include "core/noise.h"

namespace dstylize {

/// Two-scale paper texture: fine noise of about a pixel and a soft one of about eight pixels. Values have
/// mean 0 and standard deviation 1 and depend on the output pixel alone.
class Grain {
  public:
    explicit Grain(std::uint64_t seed) : fine_(seed, Purpose::paper, 0), coarse_(seed, Purpose::paper, 1) {}

    /// Values of the pixels x0 <= x < x0 + width, y0 <= y < y0 + height, row by row. Not for several
    /// threads at once: it keeps its working memory.
    const std::vector<float>& block(int x0, int y0, int width, int height);

  private:
    void add_fine(int x0, int y0, int width, int height);
    void add_coarse(int x0, int y0, int width, int height);

    Noise fine_, coarse_;
    std::vector<float> values_, white_, lattice_;
};

}  // namespace dstylize
