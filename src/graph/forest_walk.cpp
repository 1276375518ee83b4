// Parents and labels along a forest: a walk from the sources, whose stack several threads share, by vectors where it
// is long enough (detail_tile_walk-inl.h).
#include "graph/detail_forest_walk.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <condition_variable>
#include <mutex>

#include "graph/detail_owners.h"
#include "graph/detail_tiles.h"
#include "graph/detail_workers.h"

namespace dstylize {
namespace {

/// Nodes to walk on from, for several workers: what lies behind them has nothing in common.
class WalkPool {
  public:
    /// Where it starts: before any worker joins.
    Frontier& start() { return frontier_; }
    void join() {
        const std::lock_guard lock(mutex_);
        ++busy_;
    }
    /// Some of the nodes, or false when no worker has any left.
    bool take(Frontier& own) {
        std::unique_lock lock(mutex_);
        --busy_;
        ++hungry_;
        changed_.wait(lock, [&] { return frontier_.size() != 0 || busy_ == 0; });
        --hungry_;
        if (frontier_.size() == 0) {
            changed_.notify_all();
            return false;
        }
        ++busy_;
        const std::size_t count = (frontier_.size() + 1) / 2;
        frontier_.move_to(own, frontier_.size() - count, count);
        return true;
    }
    bool is_hungry() const { return hungry_.load(std::memory_order_relaxed) > 0; }
    /// Gives the oldest half of a stack away: large parts lie behind these.
    void give(Frontier& own) {
        const std::lock_guard lock(mutex_);
        own.move_to(frontier_, 0, own.size() / 2);
        changed_.notify_all();
    }

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    Frontier frontier_;
    int busy_ = 0;
    std::atomic<int> hungry_{0};
};

class ForestWalk {
  public:
    ForestWalk(const WeightedLattice& graph, Forest forest, const Work& work)
        : ground_(graph), work_(work), forest_(std::move(forest)) {}

    std::optional<Plan> run(const std::vector<Source>& sources) && {
        WalkPool pool;
        for (const Source& s : sources) {
            if (s.start >= kUnreachedWord) return {};
            settle(index(s.node), std::uint32_t(s.start), 0, pool.start());
        }
        run_workers(thread_count(work_), [&](int) { walk(pool); });
        work_.check();
        if (!fits_) return {};
        find_parents();
        for (const Source& s : sources) forest_.step[index(s.node)] = ParentColumn::kNoStep;
        ParentColumn parent(ground_.graph.lattice, std::move(forest_.step));
        OwnerColumn owner = owners_by_parents(parent, sources, work_);
        return Plan{{std::move(forest_.node), {}}, std::move(parent), std::move(owner)};
    }

  private:
    void walk(WalkPool& pool) {
        constexpr std::size_t kWorthGiving = 8;
        constexpr int kAtOnce = 256;
        Frontier frontier;
        pool.join();
        while (frontier.size() != 0 || pool.take(frontier)) {
            if (work_.stop.stop_requested()) fits_ = false;
            if (!fits_.load(std::memory_order_relaxed)) frontier.resize(0);
            if (pool.is_hungry() && frontier.size() > kWorthGiving) pool.give(frontier);
            if (frontier.size() >= kWays && !walk_on(ground_, forest_.node, frontier)) fits_ = false;
            for (int k = 0; k < kAtOnce && frontier.size() != 0 && frontier.size() < kWays; ++k) reach_last(frontier);
        }
    }

    void reach_last(Frontier& frontier) {
        const std::size_t last = frontier.size() - 1;
        const std::uint32_t place = frontier.place[last], known = frontier.sum[last];
        frontier.resize(last);
        const unsigned step = place % kMostWalkedSteps;
        const std::uint32_t v = place >> 3;
        const std::uint32_t height =
            ground_.graph.height_plane.empty() ? forest_.node[v] & 0xffff : ground_.height_to(place);
        settle(v, known + height * ground_.length5[step], 1u << (step ^ 1u), frontier);
    }

    /// `back`: the step to where the walk comes from, a bit.
    void settle(std::uint32_t v, std::uint32_t sum, std::uint32_t back, Frontier& frontier) {
        WalkedNode& node = forest_.node[v];
        const std::uint32_t weight = ground_.graph.height_plane.empty() ? node & 0xffff : 0;
        for (std::uint32_t rest = node >> 16 & 0xff & ~back; rest != 0; rest &= rest - 1) {
            const std::size_t step = std::size_t(std::countr_zero(rest));
            frontier.push(Frontier::place_of(v, 0) + ground_.ahead[step], sum + weight * ground_.length5[step]);
        }
        if (sum >= kUnreachedWord) fits_ = false;
        node = sum;
    }

    /// Makes parents of the steps, and says which nodes are unreached.
    void find_parents() {
        const Lattice& lattice = ground_.graph.lattice;
        std::atomic<bool> all_reached{true};
        share_out(std::size_t(lattice.extent().y), work_, [&](std::size_t first, std::size_t end) {
            if (!find_forest_parents(lattice, forest_.node, int(first), int(end), forest_.step)) all_reached = false;
        });
        if (all_reached) return;
        share_out(forest_.node.size(), work_, [&](std::size_t first, std::size_t end) {
            for (std::size_t n = first; n < end; ++n)
                if (forest_.node[n] >= kUnreachedWord) forest_.node[n] = LabelColumn::kUnreached32;
        });
    }

    const WalkGround ground_;
    const Work& work_;
    Forest forest_;
    std::atomic<bool> fits_{true};
};

}  // namespace

void Frontier::move_to(Frontier& other, std::size_t first, std::size_t count) {
    const auto move = [&](UnsetVector<std::uint32_t>& from, UnsetVector<std::uint32_t>& to) {
        const auto begin = from.begin() + std::ptrdiff_t(first), end = begin + std::ptrdiff_t(count);
        to.insert(to.end(), begin, end);
        from.erase(begin, end);
    };
    move(place, other.place);
    move(sum, other.sum);
}

WalkGround::WalkGround(const WeightedLattice& g) : graph(g) {
    const auto steps = g.lattice.steps();
    for (std::size_t s = 0; s < steps.size(); ++s) {
        ahead[s] = Frontier::place_of(std::uint32_t(steps[s].dy * g.lattice.extent().x + steps[s].dx), unsigned(s));
        length5[s] = steps[s].length5;
    }
}

std::optional<Plan> walk_forest(const WeightedLattice& graph, Forest forest, const std::vector<Source>& sources,
                                const Work& work) {
    return ForestWalk(graph, std::move(forest), work).run(sources);
}

}  // namespace dstylize
