#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <list>
#include <mutex>
#include <span>
#include <vector>

#include "core/grid.h"
#include "graph/detail_tile_forest.h"

namespace dstylize {

inline constexpr std::uint16_t kNoTree = 0xffff;

/// An edge that no tile can decide on alone, between trees of a tile.
struct OpenEdge {
    TileEdge edge;
    std::uint16_t tree, other;  // other is kNoTree where it lies in another tile
};

/// The lists of open edges of many tiles, kept by any number of threads. They lie in one piece, as large as the column
/// of owners that comes after them and can have its memory then: many small ones would leave holes that serve nobody.
class OpenEdges {
  public:
    explicit OpenEdges(std::size_t nodes) : room_(nodes / sizeof(OpenEdge)) {}

    std::span<const OpenEdge> keep(std::span<const OpenEdge> edges) {
        const std::size_t first = used_.fetch_add(edges.size(), std::memory_order_relaxed);
        if (first + edges.size() <= room_.size()) {
            std::copy(edges.begin(), edges.end(), room_.begin() + std::ptrdiff_t(first));
            return std::span(room_).subspan(first, edges.size());
        }
        const std::lock_guard lock(mutex_);
        return beyond_.emplace_back(edges.begin(), edges.end());
    }

  private:
    UnsetVector<OpenEdge> room_;
    std::atomic<std::size_t> used_{0};
    std::mutex mutex_;
    std::list<std::vector<OpenEdge>> beyond_;
};

}  // namespace dstylize
