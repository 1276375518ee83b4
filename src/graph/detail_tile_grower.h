#pragma once
#include <hwy/contrib/sort/vqsort.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "graph/detail_forest_walk.h"
#include "graph/detail_open_edges.h"
#include "graph/detail_tile_forest.h"
#include "graph/detail_tree_joiner.h"

namespace dstylize {

/// What is left of a tile.
struct TileRemainder {
    static constexpr int kSide = kWindow - 2;
    std::span<const OpenEdge> open;
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

    /// Sets the tile's own nodes in `forest`, keeps what is left open in `open`.
    TileRemainder grow(int tile, std::span<const std::uint16_t> sources, Forest& forest, OpenEdges& open) {
        std::array<std::uint64_t, kWindow> is_source{};
        for (const int n : sources) is_source[std::size_t(n / kWindow)] |= std::uint64_t{1} << n % kWindow;
        sift_tile(graph_, tiling_, tile, is_source, sifted_);
        sorter_(sifted_.edge, sifted_.edge_count, hwy::SortAscending());
        joiner_.begin({sifted_.root.data(), kWindowNodes});
        for (const std::uint16_t n : sources) joiner_.unite(sources[0], n);
        if (!sources.empty()) joiner_.freeze(sources[0]);
        open_.clear();
        for (std::size_t i = 0; i < sifted_.edge_count; ++i) take(TileEdge(sifted_.edge[i]));
        TileRemainder out = numbered(sources);
        out.open = open.keep(open_);
        store(tile, forest);
        return out;
    }

  private:
    void take(TileEdge e) {
        const std::uint16_t u = std::uint16_t(e.node()), v = std::uint16_t(e.other());
        if (is_rim(u) || is_rim(v)) {
            joiner_.freeze(is_rim(u) ? v : u);
            if (!is_rim(u)) open_.push_back({e, u, kNoTree});  // else the other tile's
            return;
        }
        switch (joiner_.take(u, v)) {
            case EdgeFate::closes_ring: return;
            case EdgeFate::stays_open: open_.push_back({e, u, v}); return;
            case EdgeFate::joins: break;
        }
        const unsigned step = kForwardStep[std::size_t(e.forward())];
        sifted_.steps.data()[u] |= std::uint8_t(1u << step);
        sifted_.steps.data()[v] |= std::uint8_t(1u << (step ^ 1u));
    }

    /// Trees that something outside may ask for, counted.
    TileRemainder numbered(std::span<const std::uint16_t> sources) {
        TileRemainder out;
        std::fill_n(number_, kWindowNodes, kNoTree);
        const auto number = [&](std::uint16_t node) {
            std::uint16_t& n = number_[joiner_.root(node)];
            if (n == kNoTree) n = std::uint16_t(out.tree_count++);
            return n;
        };
        for (OpenEdge& e : open_) {
            e.tree = number(e.tree);
            if (e.other != kNoTree) e.other = number(e.other);
        }
        constexpr int kLast = TileRemainder::kSide - 1;
        for (int i = 0; i <= kLast; ++i)
            for (const auto& [x, y] : {std::pair(i, 0), {i, kLast}, {0, i}, {kLast, i}})
                out.border[TileRemainder::border_place(x, y)] = number(std::uint16_t((y + 1) * kWindow + x + 1));
        if (!sources.empty()) out.source_tree = number(sources[0]);
        return out;
    }

    void store(int tile, Forest& forest) const {
        const Extent e = graph_.lattice.extent();
        const Offset origin = tiling_.origin(tile);
        const std::size_t width = std::size_t(std::min(TileRemainder::kSide, e.x - origin.dx - 1));
        for (int y = 1; y < kWindow - 1 && origin.dy + y < e.y; ++y) {
            const std::size_t first = index(graph_.lattice.at(origin.dx + 1, origin.dy + y));
            const std::uint8_t* const steps = sifted_.steps.data() + y * kWindow + 1;
            const NodeWeight* const weight = graph_.weight.data() + first;
            std::copy_n(steps, width, forest.step.data() + first);
            std::transform(weight, weight + width, steps, forest.node.data() + first, unreached);
        }
    }

    const WeightedLattice& graph_;
    const Tiling& tiling_;
    SiftedTile sifted_;
    hwy::Sorter sorter_;
    TreeJoiner<std::uint16_t> joiner_;  // a tree has the number of one of its nodes
    std::uint16_t number_[kWindowNodes];
    std::vector<OpenEdge> open_;
};

}  // namespace dstylize
