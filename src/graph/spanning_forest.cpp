// The `lexicographic` metric at the speed of memory: its paths are those of the minimum spanning forest by the order
// (height, smaller node, larger node) of edges, in which all sources count as one node.
//
// Tile by tile, in windows that lie in cache (Boruvka's and Kruskal's methods, by two laws: of the edges that leave a
// set of nodes the least is in the forest; the greatest edge of a ring is not):
//   - Each node's least edge is in the forest (all nodes at once, by vectors). What ends in one of the trees that
//     these make is not, nor is the greatest edge of a triangle: half an edge a node is left.
//   - These are sorted and taken in order. A tree that an edge has left to another tile, or that holds a source, is
//     *frozen*: what is beyond may join it by something less than what is still to come. An edge between two trees of
//     which one is not frozen is the least that leaves that one: it is in the forest. One between two frozen trees
//     stays *open*; within the tile both count as one tree from there on, as nothing later can be in the forest
//     that closes a ring with it.
// Open edges and those between tiles, 0.1 a node, are sorted and taken in order for the whole lattice (Kruskal).
// Then a walk from the sources along the forest gives parents and labels.
#include <hwy/cache_control.h>
#include <hwy/contrib/sort/vqsort.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <numeric>

#include "graph/detail_owners.h"
#include "graph/detail_spanning_forest.h"
#include "graph/detail_tile_forest.h"
#include "graph/detail_workers.h"

namespace dstylize {
namespace {

template <class Index>
Index root_of(Index* parent, Index n) {
    while (parent[n] != n) n = parent[n] = parent[parent[n]];
    return n;
}

/// A node's label takes shape in place, so that a walk touches one line of memory a node. Until it is reached `sum`
/// has its weight and `highest` the steps of its edges that are in the forest, a bit each, above kStepShift; then, its
/// label, kReached and the step that led to it.
using NodeRecord = LabelColumn::Narrow;
constexpr unsigned kStepShift = 24;
constexpr std::uint32_t kReached = 1u << (kStepShift - 1), kHighest = kReached - 1;

NodeRecord unreached(NodeWeight weight, std::uint8_t steps) {
    return {.sum = weight, .highest = std::uint32_t{steps} << kStepShift};
}
void add_step(NodeRecord& node, unsigned step) { node.highest |= 1u << (kStepShift + step); }

constexpr std::uint16_t kNoTree = 0xffff;

/// An edge that only the whole lattice can decide on, between trees of a tile.
struct OpenEdge {
    TileEdge edge;
    std::uint16_t tree, other;  // other is kNoTree where it lies in another tile
};

/// What is left of a tile.
struct TileForest {
    static constexpr int kSide = kWindow - 2;
    std::vector<OpenEdge> open;
    std::array<std::uint16_t, std::size_t{4} * kSide> border;  // trees of the outermost own nodes
    std::uint16_t source_tree = kNoTree;
    std::uint32_t tree_count = 0;

    /// x, y: of a node of the tile, less the rim.
    static std::size_t border_place(int x, int y) {
        const int place = y == 0 ? x : y == kSide - 1 ? kSide + x : x == 0 ? 2 * kSide + y : 3 * kSide + y;
        return std::size_t(place);
    }
};

/// One thread's work on a tile.
class TileGrower {
  public:
    TileGrower(const WeightedLattice& graph, const Tiling& tiling) : graph_(graph), tiling_(tiling) {}

    /// Of `nodes`, sets the tile's own.
    TileForest grow(int tile, std::span<const std::uint16_t> sources, std::span<NodeRecord> nodes) {
        std::array<std::uint64_t, kWindow> is_source{};
        for (const int n : sources) is_source[std::size_t(n / kWindow)] |= std::uint64_t{1} << n % kWindow;
        sift_tile(graph_, tiling_, tile, is_source, sifted_);
        sort_({sifted_.edge, sifted_.edge_count});
        begin(sources);
        for (std::size_t i = 0; i < sifted_.edge_count; ++i) take(TileEdge(sifted_.edge[i]));
        TileForest out = numbered(sources);
        store(tile, nodes);
        return out;
    }

  private:
    void sort_(std::span<std::uint32_t> keys) { sorter_(keys.data(), keys.size(), hwy::SortAscending()); }

    void begin(std::span<const std::uint16_t> sources) {
        std::copy_n(sifted_.root.data(), kWindowNodes, joined_);
        std::fill_n(is_frozen_, kWindowNodes, false);
        open_.clear();
        for (const std::uint16_t n : sources) joined_[root_of(joined_, n)] = root_of(joined_, sources[0]);
        if (!sources.empty()) is_frozen_[root_of(joined_, sources[0])] = true;
        std::copy_n(joined_, kWindowNodes, grown_);
    }

    void take(TileEdge e) {
        const std::uint16_t u = std::uint16_t(e.node()), v = std::uint16_t(e.other());
        if (is_rim(u) || is_rim(v)) {
            is_frozen_[root_of(joined_, is_rim(u) ? v : u)] = true;
            if (!is_rim(u)) open_.push_back({e, u, kNoTree});  // else the other tile's
            return;
        }
        const std::uint16_t a = root_of(joined_, u), b = root_of(joined_, v);
        if (a == b) return;
        joined_[b] = a;
        if (is_frozen_[a] && is_frozen_[b]) {
            open_.push_back({e, u, v});
            return;
        }
        is_frozen_[a] = is_frozen_[a] || is_frozen_[b];
        grown_[root_of(grown_, v)] = root_of(grown_, u);
        const unsigned step = kForwardStep[std::size_t(e.forward())];
        sifted_.steps.data()[u] |= std::uint8_t(1u << step);
        sifted_.steps.data()[v] |= std::uint8_t(1u << (step ^ 1u));
    }

    /// Trees that something outside may ask for, counted.
    TileForest numbered(std::span<const std::uint16_t> sources) {
        TileForest out;
        std::fill_n(number_, kWindowNodes, kNoTree);
        const auto number = [&](std::uint16_t node) {
            std::uint16_t& n = number_[root_of(grown_, node)];
            if (n == kNoTree) n = std::uint16_t(out.tree_count++);
            return n;
        };
        for (OpenEdge& e : open_) {
            e.tree = number(e.tree);
            if (e.other != kNoTree) e.other = number(e.other);
        }
        constexpr int kLast = TileForest::kSide - 1;
        for (int i = 0; i <= kLast; ++i)
            for (const auto& [x, y] : {std::pair(i, 0), {i, kLast}, {0, i}, {kLast, i}})
                out.border[TileForest::border_place(x, y)] = number(std::uint16_t((y + 1) * kWindow + x + 1));
        if (!sources.empty()) out.source_tree = number(sources[0]);
        out.open = open_;
        return out;
    }

    void store(int tile, std::span<NodeRecord> nodes) const {
        const Extent e = graph_.lattice.extent();
        const Offset origin = tiling_.origin(tile);
        const int width = std::min(TileForest::kSide, e.x - origin.dx - 1);
        for (int y = 1; y < kWindow - 1 && origin.dy + y < e.y; ++y) {
            const std::uint32_t first = index(graph_.lattice.at(origin.dx + 1, origin.dy + y));
            for (int x = 0; x < width; ++x) {
                const std::uint32_t n = first + std::uint32_t(x);
                nodes[n] = unreached(graph_.weight[n], sifted_.steps.data()[y * kWindow + 1 + x]);
            }
        }
    }

    const WeightedLattice& graph_;
    const Tiling& tiling_;
    SiftedTile sifted_;
    hwy::Sorter sorter_;
    std::uint16_t joined_[kWindowNodes];  // by edges that are in the forest or open
    std::uint16_t grown_[kWindowNodes];   // by those that are in the forest
    std::uint16_t number_[kWindowNodes];
    bool is_frozen_[kWindowNodes];  // of the roots in joined_
    std::vector<OpenEdge> open_;
};

/// An edge of the whole lattice and the trees that it joins.
struct Joint {
    std::uint64_t key;  // height, smaller node, place in kForward
    std::uint32_t a, b;
    friend bool operator<(const Joint& x, const Joint& y) { return x.key < y.key; }
};

class ForestByTiles {
  public:
    ForestByTiles(const WeightedLattice& graph, const std::vector<Source>& sources, const Work& work)
        : graph_(graph),
          tiling_(graph.lattice),
          work_(work),
          sources_of_(std::size_t(tiling_.count())),
          forest_(sources_of_.size()),
          node_(graph.lattice.node_count()) {
        for (const Source& s : sources) {
            const int i = graph.lattice.column(s.node), j = graph.lattice.row(s.node), tile = tiling_.tile_of(i, j);
            const Offset o = tiling_.origin(tile);
            sources_of_[std::size_t(tile)].push_back(std::uint16_t((j - o.dy) * kWindow + i - o.dx));
        }
    }

    UnsetVector<NodeRecord> unreached_nodes() && {
        grow_tiles();
        std::vector<Joint> joints = all_joints();
        work_.check();
        std::sort(joints.begin(), joints.end());
        join(joints);
        return std::move(node_);
    }

  private:
    void grow_tiles() {
        std::atomic<int> next{0};
        run_workers(std::min(thread_count(work_), tiling_.count()), [&](int) {
            const auto grower = std::make_unique<TileGrower>(graph_, tiling_);
            for (int tile; (tile = next++) < tiling_.count();) {
                work_.check();
                forest_[std::size_t(tile)] = grower->grow(tile, sources_of_[std::size_t(tile)], node_);
            }
        });
    }

    /// The open edges of all tiles, between trees that are counted over all tiles.
    std::vector<Joint> all_joints() {
        std::vector<std::size_t> first_edge(forest_.size() + 1);
        first_tree_.resize(forest_.size() + 1);
        for (std::size_t t = 0; t < forest_.size(); ++t) {
            first_edge[t + 1] = first_edge[t] + forest_[t].open.size();
            first_tree_[t + 1] = first_tree_[t] + forest_[t].tree_count;
        }
        std::vector<Joint> joints(first_edge.back());
        share_out(forest_.size(), work_, [&](std::size_t begin, std::size_t end) {
            for (std::size_t t = begin; t < end; ++t) {
                Joint* out = joints.data() + first_edge[t];
                for (const OpenEdge& open : forest_[t].open) *out++ = joint_of(int(t), open);
                forest_[t].open = {};
            }
        });
        return joints;
    }

    Joint joint_of(int tile, const OpenEdge& open) const {
        const auto at = [&](int node) {
            const Offset o = tiling_.origin(tile);
            return Offset{o.dx + node % kWindow, o.dy + node / kWindow};
        };
        const std::uint32_t first = first_tree_[std::size_t(tile)];
        const Offset u = at(open.edge.node());
        std::uint32_t other = first + open.other;
        if (open.other == kNoTree) {
            const Offset v = at(open.edge.other());
            const std::size_t there = std::size_t(tiling_.tile_of(v.dx, v.dy));
            constexpr int kSide = TileForest::kSide;
            other = first_tree_[there] + forest_[there].border[TileForest::border_place(v.dx % kSide, v.dy % kSide)];
        }
        const NodeId smaller = graph_.lattice.at(u.dx, u.dy);
        return {std::uint64_t{open.edge.height()} << 34 | std::uint64_t{index(smaller)} << 2 |
                    std::uint64_t(open.edge.forward()),
                first + open.tree, other};
    }

    void join(const std::vector<Joint>& joints) {
        std::vector<std::uint32_t> joined(first_tree_.back());
        std::iota(joined.begin(), joined.end(), 0u);
        std::optional<std::uint32_t> first_source;
        for (std::size_t t = 0; t < forest_.size(); ++t) {
            if (forest_[t].source_tree == kNoTree) continue;
            const std::uint32_t tree = first_tree_[t] + forest_[t].source_tree;
            if (!first_source) first_source = tree;
            joined[tree] = *first_source;
        }
        const std::uint32_t width = std::uint32_t(graph_.lattice.extent().x);
        for (const Joint& j : joints) {
            const std::uint32_t a = root_of(joined.data(), j.a);
            const std::uint32_t b = root_of(joined.data(), j.b);
            if (a == b) continue;
            joined[b] = a;
            const std::uint32_t u = std::uint32_t(j.key >> 2);
            const std::size_t forward = j.key & 3;
            const Offset ahead = kForward[forward];
            add_step(node_[u], kForwardStep[forward]);
            add_step(node_[u + std::uint32_t(ahead.dy) * width + std::uint32_t(ahead.dx)], kForwardStep[forward] ^ 1u);
        }
    }

    const WeightedLattice& graph_;
    const Tiling tiling_;
    const Work& work_;
    std::vector<std::vector<std::uint16_t>> sources_of_;  // of each tile, nodes of its window
    std::vector<TileForest> forest_;
    std::vector<std::uint32_t> first_tree_;
    UnsetVector<NodeRecord> node_;
};

/// A node that is to be reached by a step from one with this weight. One word: what is read back at once has to be
/// read as it was written.
class Arrival {
  public:
    Arrival() = default;
    Arrival(std::uint32_t node, unsigned step, std::uint32_t weight_before)
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
    void add(std::span<const Arrival> nodes) { nodes_.insert(nodes_.end(), nodes.begin(), nodes.end()); }

    /// Some of the nodes, or false when no worker has any left.
    bool take(UnsetVector<Arrival>& stack) {
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
    void give(UnsetVector<Arrival>& stack) {
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
    UnsetVector<Arrival> nodes_;
    int busy_ = 0;
    std::atomic<int> hungry_{0};
};

/// Parents and labels along the forest. Next to nothing is computed for a node, but where it lies in memory no
/// processor guesses: so several ways are followed in turns, and what each comes to next is asked for a turn ahead.
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
            std::array<Arrival, 8> next;
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
        UnsetVector<Arrival> waiting;
        std::array<Arrival, kWays> way;
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
    std::size_t follow(std::span<Arrival> way, UnsetVector<Arrival>& waiting) {
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
    std::size_t reach(Arrival at, Arrival* next) {
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
    std::size_t settle(std::uint32_t v, std::uint32_t sum, std::uint32_t highest, unsigned step, Arrival* next) {
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

std::optional<Plan> plan_spanning_forest(const PlanRequest& request, const std::vector<Source>& sources,
                                         std::uint32_t largest_height, const Work& work) {
    const WeightedLattice& g = request.graph;
    constexpr std::uint32_t kLargestHeight = 65534;
    const bool both_ways = g.height_plane.empty() || g.symmetric;
    if (g.lattice.neighbourhood() == Neighbourhood::square16 || !both_ways || largest_height > kLargestHeight)
        return {};
    UnsetVector<NodeRecord> nodes = ForestByTiles(g, sources, work).unreached_nodes();
    return ForestWalk(g, std::move(nodes), work).run(sources);
}

}  // namespace dstylize
