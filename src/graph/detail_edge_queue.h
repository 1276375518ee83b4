#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace dstylize {

/// Edges by (height, edge index): a bucket per height, and a tree of bit words, 64 wide, to find the
/// lowest height in use. Unlike a RadixQueue it takes edges of any height at any time. A bucket becomes
/// a heap, without its stale edges, when an edge is first taken from it: most edges are stale by then.
class EdgeQueue {
  public:
    struct Edge {
        std::uint32_t height;
        std::uint64_t index;
    };

    explicit EdgeQueue(std::uint32_t largest_height) : bucket_(largest_height + 1) {}

    void push(Edge e) {
        Bucket& b = bucket_[e.height];
        b.edges.push_back(e.index);
        if (b.is_heap) std::push_heap(b.edges.begin(), b.edges.end(), std::greater<>());
        leaf_[e.height / 64] |= bit(e.height % 64);
        middle_[e.height / 4096] |= bit(e.height / 64 % 64);
        root_ |= bit(e.height / 4096);
    }

    /// The least edge for which `is_stale(index)` does not hold, taken out; none when there is none.
    template <class IsStale>
    std::optional<Edge> pop(IsStale is_stale) {
        while (root_ != 0) {
            const std::uint32_t height = lowest_height();
            Bucket& b = bucket_[height];
            if (!b.is_heap) {
                std::erase_if(b.edges, is_stale);
                std::make_heap(b.edges.begin(), b.edges.end(), std::greater<>());
                b.is_heap = true;
            }
            while (!b.edges.empty()) {
                std::pop_heap(b.edges.begin(), b.edges.end(), std::greater<>());
                const std::uint64_t edge = b.edges.back();
                b.edges.pop_back();
                if (!is_stale(edge)) return Edge{height, edge};
            }
            b.is_heap = false;
            forget(height);
        }
        return std::nullopt;
    }

  private:
    struct Bucket {
        std::vector<std::uint64_t> edges;
        bool is_heap = false;
    };

    static constexpr std::uint64_t bit(std::uint32_t n) { return std::uint64_t{1} << n; }
    std::uint32_t lowest_height() const {
        const std::uint32_t high = std::uint32_t(std::countr_zero(root_));
        const std::uint32_t middle = high * 64 + std::uint32_t(std::countr_zero(middle_[high]));
        return middle * 64 + std::uint32_t(std::countr_zero(leaf_[middle]));
    }
    void forget(std::uint32_t height) {
        if ((leaf_[height / 64] &= ~bit(height % 64)) != 0) return;
        if ((middle_[height / 4096] &= ~bit(height / 64 % 64)) != 0) return;
        root_ &= ~bit(height / 4096);
    }

    std::vector<Bucket> bucket_;
    std::array<std::uint64_t, 4096> leaf_{};
    std::array<std::uint64_t, 64> middle_{};
    std::uint64_t root_ = 0;
};

}  // namespace dstylize
