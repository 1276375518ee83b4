#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "graph/detail_tile_window.h"

namespace dstylize {

/// The steps towards larger node indices, by the index that they lead to. An edge is named by its smaller node and
/// its place here, which is how edges of equal height are ordered, too.
inline constexpr std::array<Offset, 4> kForward{{{1, 0}, {-1, 1}, {0, 1}, {1, 1}}};
/// Their numbers among the steps of a lattice.
inline constexpr std::array<std::uint8_t, 4> kForwardStep{0, 7, 2, 4};

constexpr int in_window(Offset o) { return o.dy * kWindow + o.dx; }
/// Whether a node of a window belongs to another tile.
constexpr bool is_rim(int node) {
    const int x = node % kWindow, y = node / kWindow;
    return x == 0 || y == 0 || x == kWindow - 1 || y == kWindow - 1;
}

/// An edge of a window: ordered as the metric orders edges.
struct TileEdge {
    static constexpr int kNodeBits = 12;
    std::uint32_t key;     // height, node of the window, place in kForward
    TileEdge() = default;  // unset: memory for millions is not to be touched twice
    TileEdge(std::uint32_t height, int node, int forward)
        : key(height << (kNodeBits + 2) | std::uint32_t(node) << 2 | std::uint32_t(forward)) {}
    explicit TileEdge(std::uint32_t k) : key(k) {}
    std::uint32_t height() const { return key >> (kNodeBits + 2); }
    int node() const { return int(key >> 2) % (1 << kNodeBits); }
    int forward() const { return int(key & 3); }
    int other() const { return node() + in_window(kForward[std::size_t(forward())]); }
};

/// What passes over vectors make of the edges of a window (spanning_forest.cpp has the whole method).
struct SiftedTile {
    Plane<std::uint16_t> weight;     ///< far where nothing may pass
    Plane<std::uint16_t> height[4];  ///< of the edge that leaves a node by kForward[k]; far where there is none
    Plane<std::uint16_t> root;       ///< a node of the same tree, nearer its root: most often that
    Plane<std::uint8_t> chosen;      ///< bit s: step s is a node's least edge
    Plane<std::uint8_t> steps;       ///< bit s: the edge by step s is in the spanning forest
    /// TileEdge keys of those that may be in the forest as well, unordered.
    std::uint32_t edge[4 * kWindowNodes];
    std::size_t edge_count = 0;
};

/// Of each node's edges the least is in the forest, unless it leaves the tile or the node is one of `sources`: it may
/// be that none of its own is then. Bit x of sources[y]: node (x, y) of the window. Then sifts the other edges: those
/// that end in one tree are not in the forest, nor are those that are the greatest of a triangle.
void sift_tile(const WeightedLattice& graph, const Tiling& tiling, int tile,
               std::span<const std::uint64_t, kWindow> sources, SiftedTile& sifted);

}  // namespace dstylize
