#pragma once
#include <array>
#include <atomic>
#include <mutex>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

#include "graph/detail_tiles.h"

namespace dstylize {

/// The tiles with something pending, the one with the smallest pending label first. Several workers may
/// take tiles: never two that touch, as their windows overlap. Each worker prefers the blocks of tiles
/// whose data its cache has, unless the others' are much more urgent.
class TileQueue {
  public:
    /// `lead`: so much smaller the smallest pending label of another's tile has to be.
    TileQueue(const Tiling& tiling, int workers, std::uint32_t lead);
    void add(int tile, const Pending& pending);

    /// The next tile and what was pending in it. Waits while only tiles beside others' are left; nothing
    /// when all is done or abandoned.
    std::optional<TileVisit> take(int worker);
    /// After a visit that `take` gave out.
    void finish(const TileVisit& visit);
    /// Makes every `take` return nothing.
    void abandon();

  private:
    struct Tile {
        Pending pending;
        bool in_work = false;
    };
    using Entry = std::pair<std::uint32_t, int>;  // smallest pending label, tile
    using Heap = std::priority_queue<Entry, std::vector<Entry>, std::greater<>>;

    void add_locked(int tile, const Pending& pending);
    Heap& heap_of(int tile);
    Heap* next_heap(int worker);
    std::optional<TileVisit> take_free(int worker);
    bool touches_work(int tile) const;

    const Tiling tiling_;
    const std::uint32_t lead_;
    std::mutex mutex_;
    std::vector<Tile> tiles_;
    std::vector<Heap> heaps_;  // one per worker; entries that no longer hold are dropped when met
    std::vector<Entry> held_;  // met while a neighbour was in work
    int in_work_ = 0;
    bool abandoned_ = false;
    std::atomic<std::uint32_t> changes_{0};
};

}  // namespace dstylize
