// Mould's stippling flood with integer costs. Nodes within the threshold wait in buckets by
// cost: an edge costs something, so the order inside a bucket changes no cost. Nodes beyond it wait in
// a heap by (cost, index), since there the first one becomes the next stipple.
#include "graph/graph_distance.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <queue>

namespace dstylize {
namespace {

constexpr std::uint32_t kLevels = 1023;
constexpr std::uint32_t kFar = std::numeric_limits<std::uint32_t>::max();

std::uint16_t node_cost(float expense) {
    if (!(expense > 0)) return 1;
    return std::uint16_t(std::max(1L, std::lround(std::min(expense, 1.f) * float(kLevels))));
}

/// Nodes by cost, for costs that lie within one edge of each other: a ring of buckets, one per cost, and
/// a bitmap to find the next that is not empty.
class BucketRing {
  public:
    void push(std::uint32_t cost, std::uint32_t node) {
        const std::uint32_t b = cost % kCount;
        bucket_[b].push_back(node);
        occupied_[b / 64] |= std::uint64_t{1} << b % 64;
        ++size_;
    }
    bool empty() const { return size_ == 0; }
    /// Takes a node of the least cost, which is at least `from`.
    std::pair<std::uint32_t, std::uint32_t> pop(std::uint32_t from) {
        std::uint32_t w = from % kCount / 64;
        std::uint64_t word = occupied_[w] & (~std::uint64_t{0} << from % 64);
        while (word == 0) {
            w = (w + 1) % kWords;
            word = occupied_[w];
        }
        const std::uint32_t b = w * 64 + std::uint32_t(std::countr_zero(word));
        const std::uint32_t node = bucket_[b].back();
        bucket_[b].pop_back();
        if (bucket_[b].empty()) occupied_[w] &= ~(std::uint64_t{1} << b % 64);
        --size_;
        return {from + (b - from) % kCount, node};
    }

  private:
    static constexpr std::uint32_t kCount = 4096, kWords = kCount / 64;
    static_assert(kCount > 2 * kLevels + 64, "a word of the bitmap must not be met from both ends");
    std::array<std::vector<std::uint32_t>, kCount> bucket_;
    std::array<std::uint64_t, kWords> occupied_{};
    std::size_t size_ = 0;
};

/// The lattice has a rim of blocked nodes, so that no step needs a bounds check.
class Flood {
  public:
    Flood(const GraphDistanceRequest& request, const Work& work)
        : work_(work),
          extent_(request.expense.extent()),
          stride_(std::uint32_t(extent_.x) + 2),
          threshold_(std::uint32_t(std::lround(request.threshold * 2 * float(kLevels)))),
          node_(std::size_t(stride_) * (std::size_t(extent_.y) + 2)) {
        for (int j = 0; j < extent_.y; ++j)
            for (int i = 0; i < extent_.x; ++i)
                if (request.mask.empty() || request.mask(i, j) != 0)
                    node_[at(i, j)] = {kFar, node_cost(request.expense(i, j)), true};
        for (const NodeId start : request.starts) {
            const std::uint32_t n = at(int(index(start)) % extent_.x, int(index(start)) / extent_.x);
            if (node_[n].open) lower(n, 0);
        }
    }

    std::vector<NodeId> run() && {
        expand_all();
        for (int j = 0; j < extent_.y; ++j)
            for (int i = 0; i < extent_.x; ++i)
                if (node_[at(i, j)].open) {
                    lower(at(i, j), 0);
                    expand_all();
                }
        return std::move(stipples_);
    }

  private:
    struct Node {
        std::uint32_t distance = kFar;
        std::uint16_t cost = 0;
        bool open = false;  // may still be expanded
    };

    std::uint32_t at(int i, int j) const { return std::uint32_t(j + 1) * stride_ + std::uint32_t(i + 1); }

    void lower(std::uint32_t n, std::uint32_t distance) {
        node_[n].distance = distance;
        if (distance <= threshold_)
            within_.push(distance, n);
        else
            beyond_.push(std::uint64_t(distance) << 32 | n);
    }

    void expand(std::uint32_t n, std::uint32_t distance) {
        if (++expanded_ % 65536 == 0) work_.check();
        node_[n].open = false;
        for (const std::uint32_t v : {n - stride_, n - 1, n + 1, n + stride_}) {
            const std::uint32_t reached = distance + node_[n].cost + node_[v].cost;
            if (node_[v].open && reached < node_[v].distance) lower(v, reached);
        }
    }

    void expand_all() {
        for (;;) {
            for (std::uint32_t least = 0; !within_.empty();) {
                const auto [distance, n] = within_.pop(least);
                least = distance;
                if (node_[n].open && node_[n].distance == distance) expand(n, distance);
            }
            if (beyond_.empty()) return;
            const std::uint32_t n = std::uint32_t(beyond_.top());
            const std::uint32_t distance = std::uint32_t(beyond_.top() >> 32);
            beyond_.pop();
            if (!node_[n].open || node_[n].distance != distance) continue;
            stipples_.push_back(NodeId{(n / stride_ - 1) * std::uint32_t(extent_.x) + n % stride_ - 1});
            expand(n, 0);
        }
    }

    const Work& work_;
    const Extent extent_;
    const std::uint32_t stride_, threshold_;
    std::vector<Node> node_;
    BucketRing within_;
    std::priority_queue<std::uint64_t, std::vector<std::uint64_t>, std::greater<>> beyond_;
    std::vector<NodeId> stipples_;
    std::size_t expanded_ = 0;
};

}  // namespace

std::vector<NodeId> graph_distance_stipples(const GraphDistanceRequest& request, const Work& work) {
    assert(request.threshold > 0 && request.threshold <= 1e6f);
    assert(request.mask.empty() || request.mask.extent() == request.expense.extent());
    work.check();
    return Flood(request, work).run();
}

}  // namespace dstylize
