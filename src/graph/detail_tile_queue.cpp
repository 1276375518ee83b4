#include "graph/detail_tile_queue.h"

#include <thread>

namespace dstylize {

TileQueue::TileQueue(const Tiling& tiling, int workers, std::uint32_t lead)
    : tiling_(tiling), lead_(lead), tiles_(std::size_t(tiling.count())), heaps_(std::size_t(workers)) {}

TileQueue::Heap& TileQueue::heap_of(int tile) {
    constexpr int kBlock = 16;
    const int x = tile % tiling_.columns() / kBlock, y = tile / tiling_.columns() / kBlock;
    return heaps_[std::size_t(x + y) % heaps_.size()];
}

void TileQueue::add(int tile, const Pending& pending) {
    const std::lock_guard lock(mutex_);
    add_locked(tile, pending);
}

void TileQueue::add_locked(int tile, const Pending& pending) {
    Pending& p = tiles_[std::size_t(tile)].pending;
    const bool sooner = pending.least < p.least;
    p.add(pending.least, pending.largest, pending.rows, pending.columns);
    p.steep = pending.steep;
    if (sooner) heap_of(tile).push({p.least, tile});
}

TileQueue::Heap* TileQueue::next_heap(int worker) {
    Heap& own = heaps_[std::size_t(worker)];
    Heap* best = own.empty() ? nullptr : &own;
    for (Heap& other : heaps_) {
        if (other.empty() || &other == &own) continue;
        const std::uint64_t handicap = best == &own ? lead_ : 0;
        if (best == nullptr || other.top().first + handicap < best->top().first) best = &other;
    }
    return best;
}

bool TileQueue::touches_work(int tile) const {
    if (in_work_ == 0) return false;
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
            const int n = tiling_.neighbour(tile, dx, dy);
            if (n >= 0 && tiles_[std::size_t(n)].in_work) return true;
        }
    return false;
}

std::optional<TileVisit> TileQueue::take_free(int worker) {
    while (Heap* const heap = next_heap(worker)) {
        const Entry entry = heap->top();
        heap->pop();
        Tile& tile = tiles_[std::size_t(entry.second)];
        if (tile.pending.least != entry.first || !tile.pending.any()) continue;
        if (touches_work(entry.second)) {
            held_.push_back(entry);
            continue;
        }
        TileVisit visit;
        visit.tile = entry.second;
        visit.job = std::exchange(tile.pending, {});
        tile.in_work = true;
        ++in_work_;
        return visit;
    }
    return {};
}

std::optional<TileVisit> TileQueue::take(int worker) {
    std::unique_lock lock(mutex_);
    for (;;) {
        if (abandoned_) return {};
        if (auto visit = take_free(worker)) return visit;
        if (in_work_ == 0) return {};
        // Visits take some ten microseconds: less than it takes to sleep and wake.
        const std::uint32_t seen = changes_.load();
        lock.unlock();
        while (changes_.load() == seen) std::this_thread::yield();
        lock.lock();
    }
}

void TileQueue::finish(const TileVisit& visit) {
    const std::lock_guard lock(mutex_);
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
            const Pending& p = visit.after[std::size_t(3 * (dy + 1) + dx + 1)];
            if (const int n = tiling_.neighbour(visit.tile, dx, dy); p.any() && n >= 0) add_locked(n, p);
        }
    tiles_[std::size_t(visit.tile)].in_work = false;
    --in_work_;
    for (const Entry& e : held_) heap_of(e.second).push(e);
    held_.clear();
    ++changes_;
}

void TileQueue::abandon() {
    const std::lock_guard lock(mutex_);
    abandoned_ = true;
    ++changes_;
}

}  // namespace dstylize
