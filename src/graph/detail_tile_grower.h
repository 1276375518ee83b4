#pragma once
#include <hwy/contrib/sort/vqsort.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "graph/detail_node_record.h"
#include "graph/detail_tile_forest.h"

namespace dstylize {

/// The root of a node's tree, where every node points towards it; ways to it are halved by the way.
template <class Index>
Index root_of(Index* parent, Index n) {
    while (parent[n] != n) n = parent[n] = parent[parent[n]];
    return n;
}

inline constexpr std::uint16_t kNoTree = 0xffff;

/// An edge that only the whole lattice can decide on, between trees of a tile.
struct OpenEdge {
    TileEdge edge;
    std::uint16_t tree, other;  // other is kNoTree where it lies in another tile
};

/// What is left of a tile.
struct TileForest {
    static constexpr int kSide = kWindow - 2;
    std::vector<OpenEdge> open;
    std::array<std::uint16_t, std::size_t{4} * kSide> border;  // trees of the outermost own nodes
    std::uint16_t source_tree = kNoTree;
    std::uint32_t tree_count = 0;

    /// x, y: of a node of the tile, less the rim.
    static std::size_t border_place(int x, int y) {
        const int place = y == 0 ? x : y == kSide - 1 ? kSide + x : x == 0 ? 2 * kSide + y : 3 * kSide + y;
        return std::size_t(place);
    }
};

/// One thread's work on a tile.
class TileGrower {
  public:
    TileGrower(const WeightedLattice& graph, const Tiling& tiling) : graph_(graph), tiling_(tiling) {}

    /// Of `nodes`, sets the tile's own.
    TileForest grow(int tile, std::span<const std::uint16_t> sources, std::span<NodeRecord> nodes) {
        std::array<std::uint64_t, kWindow> is_source{};
        for (const int n : sources) is_source[std::size_t(n / kWindow)] |= std::uint64_t{1} << n % kWindow;
        sift_tile(graph_, tiling_, tile, is_source, sifted_);
        sorter_(sifted_.edge, sifted_.edge_count, hwy::SortAscending());
        begin(sources);
        for (std::size_t i = 0; i < sifted_.edge_count; ++i) take(TileEdge(sifted_.edge[i]));
        TileForest out = numbered(sources);
        store(tile, nodes);
        return out;
    }

  private:
    void begin(std::span<const std::uint16_t> sources) {
        std::copy_n(sifted_.root.data(), kWindowNodes, joined_);
        std::fill_n(is_frozen_, kWindowNodes, false);
        open_.clear();
        for (const std::uint16_t n : sources) joined_[root_of(joined_, n)] = root_of(joined_, sources[0]);
        if (!sources.empty()) is_frozen_[root_of(joined_, sources[0])] = true;
        std::copy_n(joined_, kWindowNodes, grown_);
    }

    void take(TileEdge e) {
        const std::uint16_t u = std::uint16_t(e.node()), v = std::uint16_t(e.other());
        if (is_rim(u) || is_rim(v)) {
            is_frozen_[root_of(joined_, is_rim(u) ? v : u)] = true;
            if (!is_rim(u)) open_.push_back({e, u, kNoTree});  // else the other tile's
            return;
        }
        const std::uint16_t a = root_of(joined_, u), b = root_of(joined_, v);
        if (a == b) return;
        joined_[b] = a;
        if (is_frozen_[a] && is_frozen_[b]) {
            open_.push_back({e, u, v});
            return;
        }
        is_frozen_[a] = is_frozen_[a] || is_frozen_[b];
        grown_[root_of(grown_, v)] = root_of(grown_, u);
        const unsigned step = kForwardStep[std::size_t(e.forward())];
        sifted_.steps.data()[u] |= std::uint8_t(1u << step);
        sifted_.steps.data()[v] |= std::uint8_t(1u << (step ^ 1u));
    }

    /// Trees that something outside may ask for, counted.
    TileForest numbered(std::span<const std::uint16_t> sources) {
        TileForest out;
        std::fill_n(number_, kWindowNodes, kNoTree);
        const auto number = [&](std::uint16_t node) {
            std::uint16_t& n = number_[root_of(grown_, node)];
            if (n == kNoTree) n = std::uint16_t(out.tree_count++);
            return n;
        };
        for (OpenEdge& e : open_) {
            e.tree = number(e.tree);
            if (e.other != kNoTree) e.other = number(e.other);
        }
        constexpr int kLast = TileForest::kSide - 1;
        for (int i = 0; i <= kLast; ++i)
            for (const auto& [x, y] : {std::pair(i, 0), {i, kLast}, {0, i}, {kLast, i}})
                out.border[TileForest::border_place(x, y)] = number(std::uint16_t((y + 1) * kWindow + x + 1));
        if (!sources.empty()) out.source_tree = number(sources[0]);
        out.open = open_;
        return out;
    }

    void store(int tile, std::span<NodeRecord> nodes) const {
        const Extent e = graph_.lattice.extent();
        const Offset origin = tiling_.origin(tile);
        const int width = std::min(TileForest::kSide, e.x - origin.dx - 1);
        for (int y = 1; y < kWindow - 1 && origin.dy + y < e.y; ++y) {
            const std::uint32_t first = index(graph_.lattice.at(origin.dx + 1, origin.dy + y));
            for (int x = 0; x < width; ++x) {
                const std::uint32_t n = first + std::uint32_t(x);
                nodes[n] = unreached(graph_.weight[n], sifted_.steps.data()[y * kWindow + 1 + x]);
            }
        }
    }

    const WeightedLattice& graph_;
    const Tiling& tiling_;
    SiftedTile sifted_;
    hwy::Sorter sorter_;
    std::uint16_t joined_[kWindowNodes];  // by edges that are in the forest or open
    std::uint16_t grown_[kWindowNodes];   // by those that are in the forest
    std::uint16_t number_[kWindowNodes];
    bool is_frozen_[kWindowNodes];  // of the roots in joined_
    std::vector<OpenEdge> open_;
};

}  // namespace dstylize
