#pragma once
#include <algorithm>

#include "core/grid.h"
#include "core/vec.h"

namespace dstylize {

/// The sample whose cell holds a point of the lattice frame, clamped into the grid.
template <class T>
const T& sample(const Grid<T>& grid, Vec2f point_lattice) {
    return grid(std::clamp(int(point_lattice.x), 0, grid.extent().x - 1),
                std::clamp(int(point_lattice.y), 0, grid.extent().y - 1));
}

}  // namespace dstylize
