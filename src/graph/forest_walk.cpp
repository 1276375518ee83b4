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
#include "graph/detail_workers.h"

namespace dstylize {
namespace {

/// A node that is to be reached by a step from one with this weight. One word: what is read back at once has to be
/// read as it was written.
class FrontierNode {
  public:
    FrontierNode() = default;
    FrontierNode(std::uint32_t node, unsigned step, std::uint32_t weight_before)
        : word_(std::uint64_t{step} << 48 | std::uint64_t{weight_before} << 32 | node) {}
    std::uint32_t node() const { return std::uint32_t(word_); }
    unsigned step() const { return unsigned(word_ >> 48); }
    std::uint32_t weight_before() const { return std::uint32_t(word_ >> 32) & 0xffff; }

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
    ForestWalk(const WeightedLattice& graph, UnsetVector<NodeRecord> nodes, const Work& work)
        : graph_(graph), work_(work), node_(std::move(nodes)) {
        const auto steps = graph.lattice.steps();
        for (std::size_t s = 0; s < steps.size(); ++s)
            ahead_[s] = {std::uint32_t(steps[s].dy * graph.lattice.extent().x + steps[s].dx), steps[s].length5};
    }

    std::optional<Plan> run(const std::vector<Source>& sources) && {
        WalkPool pool;
        for (const Source& s : sources) {
            if (s.start >= kUnreached) return {};
            std::array<FrontierNode, 8> next;
            const std::size_t count =
                settle(index(s.node), std::uint32_t(s.start), 0, ParentColumn::kNoStep, next.data());
            pool.add({next.data(), count});
        }
        run_workers(thread_count(work_),
                    [&](int) { graph_.height_plane.empty() ? walk<false>(pool) : walk<true>(pool); });
        work_.check();
        if (!fits_) return {};
        ParentColumn parent(graph_.lattice, finish_labels());
        OwnerColumn owner = owners_by_parents(parent, sources, work_);
        return Plan{std::move(node_), std::move(parent), std::move(owner)};
    }

  private:
    static constexpr std::uint32_t kUnreached = LabelColumn::kUnreached32;
    static constexpr std::size_t kWays = 32;
    static constexpr std::size_t kMostChildren = 7;

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

    /// Every way some nodes on; what waits is the next on a way that ends. Returns how many ways are left.
    template <bool kPlanes>
    std::size_t follow(std::span<FrontierNode> way, UnsetVector<FrontierNode>& waiting) {
        constexpr std::size_t kTurns = 64;
        std::size_t ways = way.size(), top = waiting.size();
        waiting.resize(top + kTurns * kWays * kMostChildren);
        for (std::size_t turn = 0; turn < kTurns; ++turn) {
            for (std::size_t w = 0; w < ways; ++w) {
                top += reach<kPlanes>(way[w], waiting.data() + top);
                if (top == 0) {
                    way[w--] = way[--ways];
                    continue;
                }
                way[w] = waiting[--top];
                hwy::Prefetch(&node_[way[w].node()]);
            }
        }
        waiting.resize(top);
        return ways;
    }

    template <bool kPlanes>
    std::size_t reach(FrontierNode at, FrontierNode* next) {
        const std::uint32_t v = at.node();
        const unsigned step = at.step();
        const std::uint32_t u = v - ahead_[step].offset;
        const std::uint32_t height =
            kPlanes ? graph_.height_plane[step / 2][step % 2 == 0 ? u : v] : at.weight_before() + node_[v].sum;
        const std::uint64_t sum = node_[u].sum + std::uint64_t{height} * ahead_[step].length5;
        if (sum >= kUnreached) fits_ = false;
        return settle(v, std::uint32_t(sum), std::max(node_[u].highest & kHighest, height), step, next);
    }

    /// Labels a node. `next`: room for its children, and for three at least; how many they are.
    std::size_t settle(std::uint32_t v, std::uint32_t sum, std::uint32_t highest, unsigned step, FrontierNode* next) {
        NodeRecord& node = node_[v];
        const std::uint32_t weight = node.sum;
        unsigned children = node.highest >> kStepShift;
        if (step != ParentColumn::kNoStep) children &= ~(1u << (step ^ 1u));
        node = {sum, step << kStepShift | kReached | highest};
        std::size_t count = 0;
        const auto put = [&] {
            const unsigned by = unsigned(std::countr_zero(children)) % 8;
            next[count] = {v + ahead_[by].offset, by, weight};
            count += children != 0;
            children &= children - 1;
        };
        // Three without asking: how many there are no processor guesses.
        put();
        put();
        put();
        while (children != 0) put();
        return count;
    }

    /// Makes labels of the records, and parents' steps.
    UnsetVector<std::uint8_t> finish_labels() {
        UnsetVector<std::uint8_t> step(node_.size());
        share_out(node_.size(), work_, [&](std::size_t first, std::size_t end) {
            for (std::size_t n = first; n < end; ++n) {
                const std::uint32_t highest = node_[n].highest;
                const bool reached = (highest & kReached) != 0;
                step[n] = reached ? std::uint8_t(highest >> kStepShift) : ParentColumn::kNoStep;
                node_[n] = {reached ? node_[n].sum : kUnreached, highest & kHighest};
            }
        });
        return step;
    }

    struct Ahead {
        std::uint32_t offset, length5;
    };
    const WeightedLattice& graph_;
    const Work& work_;
    std::array<Ahead, 8> ahead_{};
    UnsetVector<NodeRecord> node_;
    std::atomic<bool> fits_{true};
};

}  // namespace

std::optional<Plan> walk_forest(const WeightedLattice& graph, UnsetVector<NodeRecord> nodes,
                                const std::vector<Source>& sources, const Work& work) {
    return ForestWalk(graph, std::move(nodes), work).run(sources);
}

}  // namespace dstylize
