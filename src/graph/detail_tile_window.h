#pragma once
#include <cstddef>

#include "graph/detail_tiles.h"

namespace dstylize {

inline constexpr std::size_t kWindowNodes = std::size_t{kWindow} * kWindow;

/// A window's nodes, row by row, between rows that may be read but mean nothing: the reach of a step.
template <class Lane>
struct alignas(64) Plane {
    static constexpr std::size_t kMargin = 3 * kWindow;
    Lane* data() { return lanes + kMargin; }
    const Lane* data() const { return lanes + kMargin; }
    Lane lanes[kMargin + kWindowNodes + kMargin] = {};
};

/// What a visit works on, as it is [0] and transposed [1]: so sweeps go over rows only.
template <class Lane>
struct TileWindow {
    Plane<Lane> label[2];     ///< above the smallest pending one; its margins are far
    Plane<Lane> cost[2][16];  ///< of the edge that leaves a node by step s; or the half costs of load_half_costs()
    Plane<Lane> before;       ///< labels at the beginning of the visit
    Plane<Lane> weight;       ///< of nodes, or
    Plane<Lane> bottleneck;   ///< M
};

}  // namespace dstylize
