// Mould's stippling flood with integer costs. What lies within the threshold of a stipple, its cell, is reached from it
// alone, so its nodes may be relaxed in any order as long as they are closed together: in a few steps of cost, while
// the cell is in cache. Nodes beyond wait by (cost, index), since there the first one becomes the next stipple; they
// cost at most one edge more than the threshold, so that a bucket for each cost will do.
#include "graph/graph_distance.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>

#include "graph/detail_workers.h"

namespace dstylize {
namespace {

constexpr std::uint32_t kLevels = 1023, kDearestEdge = 2 * kLevels;
/// A cell grows in steps of cost, at least so many, and none wider than this: in wider ones more nodes are expanded
/// again and again, in narrower ones more wait.
constexpr std::uint64_t kLeastSteps = 4, kWidestStep = 2 * kDearestEdge;
constexpr std::size_t kNodesBetweenChecks = 1 << 16;
/// A cell comes to new rows above and below, of which no processor guesses where they are: so many ahead.
constexpr std::uint32_t kRowsAhead = 3;

std::uint16_t node_cost(float expense) {
    if (!(expense > 0)) return 1;
    return std::max<std::uint16_t>(1, std::uint16_t(std::min(expense, 1.f) * float(kLevels) + 0.5f));
}

/// Nodes with a bucket for each cost over the threshold, and a bitmap to find the first that is not empty. Inside a
/// bucket, the smallest index comes first.
class Frontier {
  public:
    void push(std::uint32_t over, std::uint32_t node) {
        std::vector<std::uint32_t>& bucket = bucket_[over];
        bucket.push_back(node);
        std::push_heap(bucket.begin(), bucket.end(), std::greater<>());
        occupied_[over / 64] |= std::uint64_t{1} << over % 64;
    }
    /// Takes the least for which `waits(over, node)` holds; the others are dropped.
    template <class Waits>
    std::optional<std::uint32_t> pop(Waits waits) {
        for (std::uint32_t word = 0; word < occupied_.size();) {
            if (occupied_[word] == 0) {
                ++word;
                continue;
            }
            const std::uint32_t over = word * 64 + std::uint32_t(std::countr_zero(occupied_[word]));
            std::vector<std::uint32_t>& bucket = bucket_[over];
            if (over != first_) {
                // Most wait no more, which is to be seen in no cache: so all are looked at together.
                first_ = over;
                std::erase_if(bucket, [&](std::uint32_t node) { return !waits(over, node); });
                std::make_heap(bucket.begin(), bucket.end(), std::greater<>());
            }
            while (!bucket.empty()) {
                std::pop_heap(bucket.begin(), bucket.end(), std::greater<>());
                const std::uint32_t node = bucket.back();
                bucket.pop_back();
                if (waits(over, node)) return node;
            }
            occupied_[word] &= occupied_[word] - 1;
        }
        return std::nullopt;
    }

  private:
    std::array<std::vector<std::uint32_t>, kDearestEdge + 1> bucket_;
    std::array<std::uint64_t, kDearestEdge / 64 + 1> occupied_{};
    std::uint32_t first_ = 0;  // the bucket that was looked through
};

/// Nodes that wait, behind one another.
class Queue {
  public:
    /// Room for so many more.
    void make_room(std::size_t count) {
        if (node_.size() - size_ < count) node_.resize(2 * node_.size() + count);
    }
    /// Without a branch, which no processor could foretell; there must be room.
    void push_if(bool wanted, std::uint32_t node) {
        node_[size_] = node;
        size_ += std::size_t(wanted);
    }
    std::size_t size() const { return size_; }
    std::uint32_t operator[](std::size_t k) const { return node_[k]; }
    std::uint32_t& operator[](std::size_t k) { return node_[k]; }
    std::span<const std::uint32_t> nodes() const { return {node_.data(), size_}; }
    void shrink(std::size_t size) { size_ = size; }

  private:
    std::vector<std::uint32_t> node_;
    std::size_t size_ = 0;
};

/// The lattice has a rim of blocked nodes, so that no step needs a bounds check, and no look ahead. A node is one word:
/// its distance above its cost. Where nothing is to be lowered any more, outside the mask and where cells are done,
/// distances are 0.
template <class Word>
class Flood {
  public:
    Flood(const GraphDistanceRequest& request, const Work& work)
        : work_(work),
          extent_(request.expense.extent()),
          stride_(std::uint32_t(extent_.x) + 2),
          threshold_(threshold(request)),
          step_(Word(std::min(threshold_ / kLeastSteps, kWidestStep))),
          node_(std::size_t(stride_) * rows()) {
        share_out(rows(), work, [&](std::size_t first, std::size_t end) {
            for (std::size_t row = first; row < end; ++row) fill_row(request, row);
        });
        for (const NodeId start : request.starts)
            start_at(at(int(index(start)) % extent_.x, int(index(start)) / extent_.x));
    }

    std::vector<NodeId> run() && {
        flood();
        std::vector<std::uint8_t> has_more(std::size_t(extent_.y));
        share_out(has_more.size(), work_, [&](std::size_t first, std::size_t end) {
            for (std::size_t j = first; j < end; ++j) {
                const auto row = node_.begin() + std::ptrdiff_t(at(0, int(j)));
                has_more[j] = std::any_of(row, row + extent_.x, [](Word node) { return node >> kCostBits != 0; });
            }
        });
        for (int j = 0; j < extent_.y; ++j)
            for (int i = 0; has_more[std::size_t(j)] != 0 && i < extent_.x; ++i)
                if (distance(at(i, j)) != 0) {
                    start_at(at(i, j));
                    flood();
                }
        return std::move(stipples_);
    }

    static std::uint64_t threshold(const GraphDistanceRequest& request) {
        return std::uint64_t(std::lround(request.threshold * 2 * float(kLevels)));
    }
    static bool holds(std::uint64_t threshold) { return threshold + kDearestEdge < kFar; }

  private:
    static constexpr int kCostBits = std::bit_width(kLevels);
    static constexpr Word kFar = std::numeric_limits<Word>::max() >> kCostBits;
    static constexpr Word kCost = (Word{1} << kCostBits) - 1;

    std::size_t rows() const { return std::size_t(extent_.y) + 2 * kRowsAhead; }
    std::uint32_t at(int i, int j) const { return (std::uint32_t(j) + kRowsAhead) * stride_ + std::uint32_t(i + 1); }
    NodeId node_at(std::uint32_t n) const {
        return NodeId{(n / stride_ - kRowsAhead) * std::uint32_t(extent_.x) + n % stride_ - 1};
    }
    Word distance(std::uint32_t n) const { return node_[n] >> kCostBits; }
    void set_distance(std::uint32_t n, Word distance) { node_[n] = distance << kCostBits | (node_[n] & kCost); }

    void fill_row(const GraphDistanceRequest& request, std::size_t row) {
        Word* const node = &node_[row * stride_];
        std::fill_n(node, stride_, Word{0});
        if (row < kRowsAhead || row >= kRowsAhead + std::size_t(extent_.y)) return;
        const int j = int(row - kRowsAhead);
        for (int i = 0; i < extent_.x; ++i)
            if (request.mask.empty() || request.mask(i, j) != 0)
                node[i + 1] = kFar << kCostBits | node_cost(request.expense(i, j));
    }

    void start_at(std::uint32_t n) {
        if (distance(n) == 0) return;
        set_distance(n, 0);
        spread(n, 0, step_);
    }

    /// Lowers the neighbours of a node at that distance: those up to `near` wait for it, the others for later.
    void spread(std::uint32_t n, Word distance, Word near) {
        near_.make_room(4);
        later_.make_room(4);
        const Word so_far = distance + (node_[n] & kCost);
        hwy::Prefetch(&node_[n - kRowsAhead * stride_]);
        hwy::Prefetch(&node_[n + kRowsAhead * stride_]);
        for (const std::uint32_t v : {n - stride_, n - 1, n + 1, n + stride_}) {
            const Word now = node_[v], cost = now & kCost, reached = so_far + cost;
            const bool nearer = reached < now >> kCostBits;
            node_[v] = nearer ? reached << kCostBits | cost : now;
            near_.push_if(nearer && reached <= near, v);
            later_.push_if(nearer && reached > near, v);
        }
    }

    /// Expands all that lies within the threshold. Nodes that were reached on a detour are expanded again: their last
    /// distance is the one that an exact order would have given, since all of the cell are closed together.
    void grow_cell() {
        std::size_t k = 0;
        for (Word near = step_;;) {
            for (; k < near_.size(); ++k) {
                if (++expanded_ % kNodesBetweenChecks == 0) work_.check();
                spread(near_[k], distance(near_[k]), near);
            }
            const Word least = least_later(near);
            if (least > threshold_) break;
            const Word before = near;
            near = Word(std::min<std::uint64_t>(least + step_, threshold_));
            bring_near(before, near);
        }
        for (const std::uint32_t n : near_.nodes()) set_distance(n, 0);
        near_.shrink(0);
        for (const std::uint32_t n : later_.nodes())
            if (const Word d = distance(n); d != 0) frontier_.push(std::uint32_t(d - threshold_), n);
        later_.shrink(0);
    }

    /// The least distance beyond `near` of what waits for later.
    Word least_later(Word near) const {
        Word least = kFar;
        for (const std::uint32_t n : later_.nodes())
            if (const Word d = distance(n); d > near) least = std::min(least, d);
        return least;
    }

    /// Sorts out again what waits for later; what has come nearer than `before` has been expanded.
    void bring_near(Word before, Word near) {
        near_.make_room(later_.size());
        std::size_t kept = 0;
        for (std::size_t k = 0; k < later_.size(); ++k) {
            const std::uint32_t n = later_[k];
            const Word d = distance(n);
            near_.push_if(d > before && d <= near, n);
            later_[kept] = n;
            kept += std::size_t(d > near);
        }
        later_.shrink(kept);
    }

    void flood() {
        grow_cell();
        const auto waits = [&](std::uint32_t over, std::uint32_t n) { return distance(n) == threshold_ + over; };
        while (const auto n = frontier_.pop(waits)) {
            stipples_.push_back(node_at(*n));
            start_at(*n);
            grow_cell();
        }
    }

    const Work& work_;
    const Extent extent_;
    const std::uint32_t stride_;
    const std::uint64_t threshold_;
    const Word step_;
    UnsetVector<Word> node_;
    Queue near_, later_;  // of the cell that grows
    Frontier frontier_;
    std::vector<NodeId> stipples_;
    std::size_t expanded_ = 0;
};

}  // namespace

std::vector<NodeId> graph_distance_stipples(const GraphDistanceRequest& request, const Work& work) {
    assert(request.threshold > 0 && request.threshold <= 1e6f);
    assert(request.mask.empty() || request.mask.extent() == request.expense.extent());
    work.check();
    if (Flood<std::uint32_t>::holds(Flood<std::uint32_t>::threshold(request)))
        return Flood<std::uint32_t>(request, work).run();
    return Flood<std::uint64_t>(request, work).run();
}

}  // namespace dstylize
