#pragma once
#include <cstdint>

#include "graph/weighted_lattice.h"

namespace dstylize {

/// Bounds on what an edge can cost. Where there is none, any will do.
struct EdgeRange {
    std::uint64_t least_cost, largest_cost;
    std::uint32_t largest_height;
};
EdgeRange edge_range(const WeightedLattice& g);

}  // namespace dstylize
