#pragma once
#include <cstddef>
#include <span>

#include "core/picture.h"

namespace dstylize::codec {

/// Where the pixels of a stored picture go in the upright one. `orientation` is EXIF's (tag 0x0112): 1 as
/// stored, 2 mirrored, 3 half turn, 4 flipped, 5 transposed, 6 to be turned clockwise, 7 transverse,
/// 8 to be turned anticlockwise; anything else counts as 1.
class Upright {
  public:
    Upright(Extent stored, int orientation) : stored_(stored) {
        const bool known = orientation >= 1 && orientation <= 8;
        const int turn = known ? orientation : 1;
        swaps_ = turn >= 5;
        const bool reverse_x = turn == 2 || turn == 3 || turn == 7 || turn == 8;
        const bool reverse_y = turn == 3 || turn == 4 || turn == 6 || turn == 7;
        // Moving by one stored pixel or row moves by one upright pixel or row, in either sense.
        const std::ptrdiff_t width = swaps_ ? stored.y : stored.x;
        step_x_ = (swaps_ ? width : 1) * (reverse_x ? -1 : 1);
        step_y_ = (swaps_ ? 1 : width) * (reverse_y ? -1 : 1);
        if (reverse_x) first_ -= step_x_ * (stored.x - 1);
        if (reverse_y) first_ -= step_y_ * (stored.y - 1);
    }

    Extent extent() const { return swaps_ ? Extent{stored_.y, stored_.x} : stored_; }

    /// Puts whole stored rows, `row` first, into the upright picture. Cheapest with some 64 rows a call.
    void place(std::span<const Rgba8> rows, int row, std::span<Rgba8> upright) const {
        const std::ptrdiff_t width = stored_.x, count = std::ptrdiff_t(rows.size()) / width;
        const auto target = [&](std::ptrdiff_t i, std::ptrdiff_t j) -> Rgba8& {
            return upright[std::size_t(first_ + i * step_x_ + (row + j) * step_y_)];
        };
        // The inner loop runs along upright rows, so that writing stays within cache lines.
        if (swaps_)
            for (std::ptrdiff_t i = 0; i < width; ++i)
                for (std::ptrdiff_t j = 0; j < count; ++j) target(i, j) = rows[std::size_t(j * width + i)];
        else
            for (std::ptrdiff_t j = 0; j < count; ++j)
                for (std::ptrdiff_t i = 0; i < width; ++i) target(i, j) = rows[std::size_t(j * width + i)];
    }

  private:
    Extent stored_;
    bool swaps_ = false;
    std::ptrdiff_t first_ = 0, step_x_ = 1, step_y_ = 1;
};

}  // namespace dstylize::codec
