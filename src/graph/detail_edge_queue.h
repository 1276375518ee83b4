#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <functional>
#include <vector>

namespace dstylize {

/// Edges by (height, edge index): a small heap per height, and a tree of bit words, 64 wide, to find
/// the lowest height in use. Unlike a RadixQueue it takes edges of any height at any time.
class EdgeQueue {
  public:
    struct Edge {
        std::uint32_t height;
        std::uint64_t index;
    };

    explicit EdgeQueue(std::uint32_t largest_height) : heap_(largest_height + 1) {}

    bool empty() const { return root_ == 0; }

    void push(Edge e) {
        std::vector<std::uint64_t>& heap = heap_[e.height];
        heap.push_back(e.index);
        std::push_heap(heap.begin(), heap.end(), std::greater<>());
        leaf_[e.height / 64] |= bit(e.height % 64);
        middle_[e.height / 4096] |= bit(e.height / 64 % 64);
        root_ |= bit(e.height / 4096);
    }

    Edge pop() {
        std::uint32_t height = std::uint32_t(std::countr_zero(root_));
        height = height * 64 + std::uint32_t(std::countr_zero(middle_[height]));
        height = height * 64 + std::uint32_t(std::countr_zero(leaf_[height]));
        std::vector<std::uint64_t>& heap = heap_[height];
        std::pop_heap(heap.begin(), heap.end(), std::greater<>());
        const Edge least{height, heap.back()};
        heap.pop_back();
        if (heap.empty() && (leaf_[height / 64] &= ~bit(height % 64)) == 0 &&
            (middle_[height / 4096] &= ~bit(height / 64 % 64)) == 0)
            root_ &= ~bit(height / 4096);
        return least;
    }

  private:
    static constexpr std::uint64_t bit(std::uint32_t n) { return std::uint64_t{1} << n; }
    std::vector<std::vector<std::uint64_t>> heap_;
    std::array<std::uint64_t, 4096> leaf_{};
    std::array<std::uint64_t, 64> middle_{};
    std::uint64_t root_ = 0;
};

}  // namespace dstylize
