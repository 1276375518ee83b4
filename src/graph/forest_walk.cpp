// Parents and labels along a forest. Next to nothing is computed for a node, but where it lies in memory no processor
// guesses: so several ways are followed in turns, and what each comes to next is asked for a turn ahead.
#include "graph/detail_forest_walk.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <condition_variable>
#include <mutex>
#include <span>

#include "graph/detail_owners.h"
#include "graph/detail_tiles.h"
#include "graph/detail_workers.h"

namespace dstylize {
namespace {

/// A node that is to be reached, by a step, with what is known of its sum before it is looked at. One word: what is
/// read back at once has to be read as it was written.
class FrontierNode {
  public:
    FrontierNode() = default;
    FrontierNode(std::uint32_t place, std::uint32_t sum) : word_(std::uint64_t{sum} << 32 | place) {}
    /// A node and a step. Places are added as nodes are.
    static constexpr std::uint32_t place(std::uint32_t node, unsigned step) { return node << 3 | step; }
    std::uint32_t place() const { return std::uint32_t(word_); }
    std::uint32_t node() const { return place() >> 3; }
    unsigned step() const { return unsigned(word_) & 7; }
    std::uint32_t sum() const { return std::uint32_t(word_ >> 32); }
    /// Without a branch, as no processor guesses which.
    static FrontierNode choose(bool second, FrontierNode a, FrontierNode b) {
        a.word_ ^= (a.word_ ^ b.word_) & (std::uint64_t{0} - second);
        return a;
    }

  private:
    std::uint64_t word_;
};

/// Nodes to walk on from, for several workers: what lies behind them has nothing in common.
class WalkPool {
  public:
    /// Before any worker joins.
    void add(std::span<const FrontierNode> nodes) { nodes_.insert(nodes_.end(), nodes.begin(), nodes.end()); }

    /// Some of the nodes, or false when no worker has any left.
    bool take(UnsetVector<FrontierNode>& stack) {
        std::unique_lock lock(mutex_);
        --busy_;
        ++hungry_;
        changed_.wait(lock, [&] { return !nodes_.empty() || busy_ == 0; });
        --hungry_;
        if (nodes_.empty()) {
            changed_.notify_all();
            return false;
        }
        ++busy_;
        const std::ptrdiff_t count = std::ptrdiff_t(nodes_.size() + 1) / 2;
        stack.assign(nodes_.end() - count, nodes_.end());
        nodes_.erase(nodes_.end() - count, nodes_.end());
        return true;
    }
    bool is_hungry() const { return hungry_.load(std::memory_order_relaxed) > 0; }
    /// Gives the oldest half of a stack away: large parts lie behind these.
    void give(UnsetVector<FrontierNode>& stack) {
        const std::lock_guard lock(mutex_);
        const std::ptrdiff_t count = std::ptrdiff_t(stack.size() / 2);
        nodes_.insert(nodes_.end(), stack.begin(), stack.begin() + count);
        stack.erase(stack.begin(), stack.begin() + count);
        changed_.notify_all();
    }
    void join() {
        const std::lock_guard lock(mutex_);
        ++busy_;
    }

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    UnsetVector<FrontierNode> nodes_;
    int busy_ = 0;
    std::atomic<int> hungry_{0};
};

class ForestWalk {
  public:
    ForestWalk(const WeightedLattice& graph, Forest forest, const Work& work)
        : graph_(graph), work_(work), forest_(std::move(forest)) {
        const auto steps = graph.lattice.steps();
        for (std::size_t s = 0; s < steps.size(); ++s)
            ahead_[s] = {
                FrontierNode::place(std::uint32_t(steps[s].dy * graph.lattice.extent().x + steps[s].dx), unsigned(s)),
                steps[s].length5};
    }

    std::optional<Plan> run(const std::vector<Source>& sources) && {
        graph_.height_plane.empty() ? walk_from<false>(sources) : walk_from<true>(sources);
        work_.check();
        if (!fits_) return {};
        find_parents();
        for (const Source& s : sources) forest_.step[index(s.node)] = ParentColumn::kNoStep;
        ParentColumn parent(graph_.lattice, std::move(forest_.step));
        OwnerColumn owner = owners_by_parents(parent, sources, work_);
        return Plan{{std::move(forest_.node), {}}, std::move(parent), std::move(owner)};
    }

  private:
    static constexpr std::size_t kWays = 32;
    static constexpr std::size_t kMostChildren = 8;

    /// A node that has its sum, and the steps by which the walk goes on.
    struct ReachedNode {
        std::uint32_t node, sum, weight, children;
    };

    template <bool kPlanes>
    void walk_from(const std::vector<Source>& sources) {
        WalkPool pool;
        for (const Source& s : sources) {
            if (s.start >= kUnreachedWord) {
                fits_ = false;
                return;
            }
            ReachedNode at = settle(index(s.node), std::uint32_t(s.start));
            while (at.children != 0) {
                const FrontierNode child = take_child<kPlanes>(at);
                pool.add({&child, 1});
            }
        }
        run_workers(thread_count(work_), [&](int) { walk<kPlanes>(pool); });
    }

    template <bool kPlanes>
    void walk(WalkPool& pool) {
        constexpr std::size_t kWorthGiving = 8;
        UnsetVector<FrontierNode> waiting;
        std::array<FrontierNode, kWays> way;
        std::size_t ways = 0;
        pool.join();
        for (;;) {
            if (work_.stop.stop_requested()) fits_ = false;
            if (!fits_.load(std::memory_order_relaxed)) waiting.clear(), ways = 0;
            for (; ways < kWays && !waiting.empty(); waiting.pop_back()) way[ways++] = waiting.back();
            if (ways == 0) {
                if (!pool.take(waiting)) break;
                continue;
            }
            if (pool.is_hungry() && waiting.size() > kWorthGiving) pool.give(waiting);
            ways = follow<kPlanes>({way.data(), ways}, waiting);
        }
    }

    /// Every way some nodes on: to the first child; the others wait, and one that waits is next on a way that ends.
    /// Returns how many ways are left.
    template <bool kPlanes>
    std::size_t follow(std::span<FrontierNode> way, UnsetVector<FrontierNode>& waiting) {
        constexpr std::size_t kTurns = 64;
        std::size_t ways = way.size(), top = waiting.size();
        waiting.resize(top + kTurns * kWays * kMostChildren);
        for (std::size_t turn = 0; turn < kTurns; ++turn) {
            for (std::size_t w = 0; w < ways; ++w) {
                ReachedNode at = reach<kPlanes>(way[w]);
                const bool ends = at.children == 0;
                if (ends && top == 0) {
                    way[w--] = way[--ways];
                    continue;
                }
                const FrontierNode waited = waiting[top - (top != 0)], first = take_child<kPlanes>(at);
                top -= ends;
                // One more without asking: how many there are no processor guesses.
                std::size_t more = at.children != 0;
                waiting[top] = take_child<kPlanes>(at);
                top += more;
                while (at.children != 0) waiting[top++] = take_child<kPlanes>(at);
                way[w] = FrontierNode::choose(ends, first, waited);
                hwy::Prefetch(&forest_.node[way[w].node()]);
            }
        }
        waiting.resize(top);
        return ways;
    }

    template <bool kPlanes>
    ReachedNode reach(FrontierNode to) {
        const std::uint32_t v = to.node();
        const unsigned step = to.step();
        const Ahead& by = ahead_[step];
        const std::uint32_t height =
            kPlanes ? graph_.height_plane[step / 2][step % 2 == 0 ? (to.place() - by.place) >> 3 : v]
                    : forest_.node[v] & 0xffff;
        ReachedNode reached = settle(v, to.sum() + height * by.length5);
        reached.children &= ~(1u << (step ^ 1u));
        return reached;
    }

    ReachedNode settle(std::uint32_t v, std::uint32_t sum) {
        WalkedNode& node = forest_.node[v];
        const ReachedNode reached{v, sum, node & 0xffff, node >> 16 & 0xff};
        if (sum >= kUnreachedWord) fits_ = false;
        node = sum;
        return reached;
    }

    /// The first child, which is no child any more; anything if there is none.
    template <bool kPlanes>
    FrontierNode take_child(ReachedNode& at) const {
        const Ahead& ahead = ahead_[std::size_t(std::countr_zero(at.children | 1u << kMostChildren))];
        at.children &= at.children - 1;
        return {FrontierNode::place(at.node, 0) + ahead.place,
                kPlanes ? at.sum : at.sum + at.weight * ahead.length5};
    }

    /// Makes parents of the steps, and says which nodes are unreached.
    void find_parents() {
        const Extent e = graph_.lattice.extent();
        std::atomic<bool> all_reached{true};
        share_out(std::size_t(e.y), work_, [&](std::size_t first, std::size_t end) {
            if (!find_forest_parents(graph_.lattice, forest_.node, int(first), int(end), forest_.step))
                all_reached = false;
        });
        if (all_reached) return;
        share_out(forest_.node.size(), work_, [&](std::size_t first, std::size_t end) {
            for (std::size_t n = first; n < end; ++n)
                if (forest_.node[n] >= kUnreachedWord) forest_.node[n] = LabelColumn::kUnreached32;
        });
    }

    struct Ahead {
        std::uint32_t place, length5;
    };
    const WeightedLattice& graph_;
    const Work& work_;
    std::array<Ahead, kMostChildren + 1> ahead_{};  // the last leads nowhere
    Forest forest_;
    std::atomic<bool> fits_{true};
};

}  // namespace

std::optional<Plan> walk_forest(const WeightedLattice& graph, Forest forest, const std::vector<Source>& sources,
                                const Work& work) {
    return ForestWalk(graph, std::move(forest), work).run(sources);
}

}  // namespace dstylize
