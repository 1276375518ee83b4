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

    /// `steps`: bit s of a node, the edge by step s is in the forest; set for the tile's own nodes.
    TileForest grow(int tile, std::span<const std::uint16_t> sources, std::span<std::uint8_t> steps) {
        std::array<std::uint64_t, kWindow> is_source{};
        for (const int n : sources) is_source[std::size_t(n / kWindow)] |= std::uint64_t{1} << n % kWindow;
        sift_tile(graph_, tiling_, tile, is_source, sifted_);
        sort_({sifted_.edge, sifted_.edge_count});
        begin(sources);
        for (std::size_t i = 0; i < sifted_.edge_count; ++i) take(TileEdge(sifted_.edge[i]));
        TileForest out = numbered(sources);
        store(tile, steps);
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

    void store(int tile, std::span<std::uint8_t> steps) const {
        const Extent e = graph_.lattice.extent();
        const Offset origin = tiling_.origin(tile);
        const int width = std::min(TileForest::kSide, e.x - origin.dx - 1);
        for (int y = 1; y < kWindow - 1 && origin.dy + y < e.y; ++y)
            std::copy_n(sifted_.steps.data() + y * kWindow + 1, width,
                        steps.data() + index(graph_.lattice.at(origin.dx + 1, origin.dy + y)));
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
          steps_(graph.lattice.node_count()) {
        for (const Source& s : sources) {
            const int i = graph.lattice.column(s.node), j = graph.lattice.row(s.node), tile = tiling_.tile_of(i, j);
            const Offset o = tiling_.origin(tile);
            sources_of_[std::size_t(tile)].push_back(std::uint16_t((j - o.dy) * kWindow + i - o.dx));
        }
    }

    /// Of every node: bit s, the edge by step s is in the forest.
    UnsetVector<std::uint8_t> steps() && {
        grow_tiles();
        std::vector<Joint> joints = all_joints();
        work_.check();
        std::sort(joints.begin(), joints.end());
        join(joints);
        return std::move(steps_);
    }

  private:
    void grow_tiles() {
        std::atomic<int> next{0};
        run_workers(std::min(thread_count(work_), tiling_.count()), [&](int) {
            const auto grower = std::make_unique<TileGrower>(graph_, tiling_);
            for (int tile; (tile = next++) < tiling_.count();) {
                work_.check();
                forest_[std::size_t(tile)] = grower->grow(tile, sources_of_[std::size_t(tile)], steps_);
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
            steps_[u] |= std::uint8_t(1u << kForwardStep[forward]);
            steps_[u + std::uint32_t(ahead.dy) * width + std::uint32_t(ahead.dx)] |=
                std::uint8_t(1u << (kForwardStep[forward] ^ 1u));
        }
    }

    const WeightedLattice& graph_;
    const Tiling tiling_;
    const Work& work_;
    std::vector<std::vector<std::uint16_t>> sources_of_;  // of each tile, nodes of its window
    std::vector<TileForest> forest_;
    std::vector<std::uint32_t> first_tree_;
    UnsetVector<std::uint8_t> steps_;
};

/// Nodes that wait to be walked on from, for several workers: what lies behind them has nothing in common.
class WalkPool {
  public:
    explicit WalkPool(std::vector<std::uint32_t> nodes) : nodes_(std::move(nodes)) {}

    /// Some of the nodes, or false when no worker has any left.
    bool take(std::vector<std::uint32_t>& stack) {
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
    void give(std::vector<std::uint32_t>& stack) {
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
    std::vector<std::uint32_t> nodes_;
    int busy_ = 0;
    std::atomic<int> hungry_{0};
};

/// Parents and labels along the forest.
class ForestWalk {
  public:
    ForestWalk(const WeightedLattice& graph, UnsetVector<std::uint8_t> forest, const Work& work)
        : graph_(graph),
          work_(work),
          forest_(std::move(forest)),
          step_(forest_.size()),
          sum_(forest_.size()),
          highest_(forest_.size()) {
        const auto steps = graph.lattice.steps();
        for (std::size_t s = 0; s < steps.size(); ++s)
            ahead_[s] = {std::uint32_t(steps[s].dy * graph.lattice.extent().x + steps[s].dx), steps[s].length5};
        share_out(forest_.size(), work, [&](std::size_t first, std::size_t end) {
            std::fill(step_.begin() + std::ptrdiff_t(first), step_.begin() + std::ptrdiff_t(end),
                      ParentColumn::kNoStep);
            std::fill(sum_.begin() + std::ptrdiff_t(first), sum_.begin() + std::ptrdiff_t(end),
                      LabelColumn::kUnreached32);
        });
    }

    std::optional<Plan> run(const std::vector<Source>& sources) && {
        std::vector<std::uint32_t> nodes;
        for (const Source& s : sources) {
            if (s.start >= LabelColumn::kUnreached32) return {};
            sum_[index(s.node)] = std::uint32_t(s.start);
            highest_[index(s.node)] = 0;
            nodes.push_back(index(s.node));
        }
        WalkPool pool(std::move(nodes));
        run_workers(thread_count(work_),
                    [&](int) { graph_.height_plane.empty() ? walk<false>(pool) : walk<true>(pool); });
        work_.check();
        if (!fits_) return {};
        ParentColumn parent(graph_.lattice, std::move(step_));
        OwnerColumn owner = owners_by_parents(sum_, parent, sources, work_);
        return Plan{{std::move(sum_), std::move(highest_)}, std::move(parent), std::move(owner)};
    }

  private:
    template <bool kPlanes>
    void walk(WalkPool& pool) {
        constexpr std::size_t kWorthGiving = 8;
        std::vector<std::uint32_t> stack;
        pool.join();
        for (;;) {
            if (stack.empty()) {
                if (work_.stop.stop_requested()) fits_ = false;
                if (!pool.take(stack)) return;
            }
            if (pool.is_hungry() && stack.size() > kWorthGiving) pool.give(stack);
            const std::uint32_t from = stack.back();
            stack.pop_back();
            if (fits_.load(std::memory_order_relaxed)) follow<kPlanes>(from, stack);
        }
    }

    /// The last of a node's children is followed at once, the others wait.
    template <bool kPlanes>
    void follow(std::uint32_t u, std::vector<std::uint32_t>& stack) {
        for (;;) {
            unsigned children = forest_[u];
            if (step_[u] != ParentColumn::kNoStep) children &= ~(1u << (step_[u] ^ 1u));
            if (children == 0) return;
            const std::uint32_t next = enter<kPlanes>(u, unsigned(std::countr_zero(children)));
            for (children &= children - 1; children != 0; children &= children - 1)
                stack.push_back(enter<kPlanes>(u, unsigned(std::countr_zero(children))));
            u = next;
        }
    }

    template <bool kPlanes>
    std::uint32_t enter(std::uint32_t u, unsigned step) {
        const std::uint32_t v = u + ahead_[step].offset;
        const std::uint32_t height = kPlanes ? graph_.height_plane[step / 2][step % 2 == 0 ? u : v]
                                             : std::uint32_t(graph_.weight[u]) + graph_.weight[v];
        const std::uint64_t sum = sum_[u] + std::uint64_t{height} * ahead_[step].length5;
        if (sum >= LabelColumn::kUnreached32) fits_ = false;
        sum_[v] = std::uint32_t(sum);
        highest_[v] = std::max(highest_[u], height);
        step_[v] = std::uint8_t(step);
        return v;
    }

    struct Ahead {
        std::uint32_t offset, length5;
    };
    const WeightedLattice& graph_;
    const Work& work_;
    const UnsetVector<std::uint8_t> forest_;
    std::array<Ahead, 8> ahead_{};
    UnsetVector<std::uint8_t> step_;
    UnsetVector<std::uint32_t> sum_, highest_;
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
    UnsetVector<std::uint8_t> forest = ForestByTiles(g, sources, work).steps();
    return ForestWalk(g, std::move(forest), work).run(sources);
}

}  // namespace dstylize
