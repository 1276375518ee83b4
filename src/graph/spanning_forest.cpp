// The `lexicographic` metric at the speed of memory: its paths are those of the minimum spanning forest by the order
// (height, smaller node, larger node) of edges, in which all sources count as one node.
//
// From small parts of the lattice to all of it, each part in cache (Boruvka's and Kruskal's methods, by two laws: of
// the edges that leave a set of nodes the least is in the forest; the greatest edge of a ring is not):
//   - Tiles. Each node's least edge is in the forest (all nodes at once, by vectors). What ends in one of the trees
//     that these make is not, nor is the greatest edge of a triangle: half an edge a node is left. These are sorted
//     and taken in order (detail_tree_joiner.h), and 0.06 edges a node stay open: some within the tile, as only who
//     sees its surroundings can tell, and those between tiles.
//   - Blocks of tiles take what is open in the same way; then the whole lattice takes what is left.
// Then a walk from the sources along the forest gives parents and labels.
#include "graph/detail_spanning_forest.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <numeric>
#include <utility>

#include "graph/detail_forest_walk.h"
#include "graph/detail_tile_grower.h"
#include "graph/detail_workers.h"

namespace dstylize {
namespace {

/// An edge of the whole lattice and the trees that it joins.
struct CandidateEdge {
    std::uint64_t key;  // height, smaller node, place in kForward
    std::uint32_t a, b;
    friend bool operator<(const CandidateEdge& x, const CandidateEdge& y) { return x.key < y.key; }
};

/// Tiles in blocks, and their trees, counted block by block. Each tile has one at least.
class BlockedTrees {
  public:
    BlockedTrees(const Tiling& tiling, const std::vector<TileRemainder>& left)
        : tiling_(tiling),
          left_(left),
          columns_(in_blocks(tiling.columns())),
          rows_(in_blocks(tiling.rows())),
          first_tree_(left.size()) {
        for (int block = 0; block < count(); ++block) {
            first_of_block_.push_back(tree_count_);
            for_tiles(block, 0, [&](int tile) {
                first_tree_[std::size_t(tile)] = tree_count_;
                tree_count_ += left[std::size_t(tile)].tree_count;
            });
        }
        first_of_block_.push_back(tree_count_);
    }

    int count() const { return columns_ * rows_; }
    std::uint32_t tree_count() const { return tree_count_; }
    std::uint32_t first_tree(int block) const { return first_of_block_[std::size_t(block)]; }
    std::uint32_t tree_count(int block) const { return first_tree(block + 1) - first_tree(block); }
    std::uint32_t first_tree_of_tile(int tile) const { return first_tree_[std::size_t(tile)]; }

    /// Calls visit(tile) for the tiles of a block, and so many around it.
    template <class Visit>
    void for_tiles(int block, int around, Visit visit) const {
        const int x = block % columns_ * kSide, y = block / columns_ * kSide;
        for (int j = std::max(0, y - around); j < std::min(tiling_.rows(), y + kSide + around); ++j)
            for (int i = std::max(0, x - around); i < std::min(tiling_.columns(), x + kSide + around); ++i)
                visit(j * tiling_.columns() + i);
    }

    /// The tree at the other end of an open edge.
    std::uint32_t other_tree(int tile, const OpenEdge& open) const {
        if (open.other != kNoTree) return first_tree_[std::size_t(tile)] + open.other;
        const int node = open.edge.other(), x = node % kWindow - 1, y = node / kWindow - 1;
        constexpr int kTile = TileRemainder::kSide;
        const int right = (x == kTile) - (x < 0), down = (y == kTile) - (y < 0);
        const std::size_t there = std::size_t(tile + down * tiling_.columns() + right);
        return first_tree_[there] +
               left_[there].border[TileRemainder::border_place(x - right * kTile, y - down * kTile)];
    }

    CandidateEdge candidate(const Lattice& lattice, int tile, const OpenEdge& open) const {
        const Offset o = tiling_.origin(tile);
        const NodeId u = lattice.at(o.dx + open.edge.node() % kWindow, o.dy + open.edge.node() / kWindow);
        return {
            std::uint64_t{open.edge.height()} << 34 | std::uint64_t{index(u)} << 2 | std::uint64_t(open.edge.forward()),
            first_tree_[std::size_t(tile)] + open.tree, other_tree(tile, open)};
    }

  private:
    /// What is open in a block fits into a core's cache.
    static constexpr int kSide = 8;
    static int in_blocks(int tiles) { return (tiles + kSide - 1) / kSide; }
    const Tiling& tiling_;
    const std::vector<TileRemainder>& left_;
    int columns_, rows_;
    std::vector<std::uint32_t> first_tree_, first_of_block_;
    std::uint32_t tree_count_ = 0;
};

class ForestByTiles {
  public:
    ForestByTiles(const WeightedLattice& graph, const std::vector<Source>& sources, const Work& work)
        : graph_(graph),
          tiling_(graph.lattice),
          work_(work),
          sources_of_(std::size_t(tiling_.count())),
          left_(sources_of_.size()),
          forest_(graph.lattice.node_count()) {
        for (const Source& s : sources) {
            const int i = graph.lattice.column(s.node), j = graph.lattice.row(s.node), tile = tiling_.tile_of(i, j);
            const Offset o = tiling_.origin(tile);
            sources_of_[std::size_t(tile)].push_back(std::uint16_t((j - o.dy) * kWindow + i - o.dx));
        }
    }

    Forest grown() && {
        auto open_edges = std::make_unique<OpenEdges>(graph_.lattice.node_count());
        for_each(
            tiling_.count(), [&] { return std::make_unique<TileGrower>(graph_, tiling_); },
            [&](int tile, TileGrower& grower) {
                left_[std::size_t(tile)] = grower.grow(tile, sources_of_[std::size_t(tile)], forest_, *open_edges);
            });
        const BlockedTrees trees(tiling_, left_);
        std::vector<std::vector<CandidateEdge>> open(std::size_t(trees.count()));
        std::vector<std::uint32_t> tree(trees.tree_count());
        for_each(
            trees.count(), [] { return std::make_unique<BlockScratch>(); },
            [&](int block, BlockScratch& scratch) {
                take_block(trees, block, scratch, tree);
                open[std::size_t(block)] = scratch.open;
            });
        open_edges.reset();
        take_rest(trees, std::move(open), std::move(tree));
        return std::move(forest_);
    }

  private:
    /// Memory of one thread.
    struct BlockScratch {
        std::vector<CandidateEdge> candidates, open;
        TreeJoiner<std::uint32_t> joiner;
    };

    /// Calls body(index, scratch) for all indices below `count`, by several threads, each with a scratch of its own.
    template <class MakeScratch, class Body>
    void for_each(int count, const MakeScratch& make_scratch, const Body& body) {
        std::atomic<int> next{0};
        run_workers(std::min(thread_count(work_), count), [&](int) {
            const auto scratch = make_scratch();
            for (int k; (k = next++) < count;) {
                work_.check();
                body(k, *scratch);
            }
        });
    }

    void take_block(const BlockedTrees& trees, int block, BlockScratch& scratch, std::vector<std::uint32_t>& tree) {
        const std::uint32_t first = trees.first_tree(block), count = trees.tree_count(block);
        const auto is_own = [&](std::uint32_t t) { return t - first < count; };
        scratch.candidates.clear();
        scratch.open.clear();
        trees.for_tiles(block, 1, [&](int tile) {
            const bool own = is_own(trees.first_tree_of_tile(tile));
            for (const OpenEdge& edge : left_[std::size_t(tile)].open)
                if (own || (edge.other == kNoTree && is_own(trees.other_tree(tile, edge))))
                    scratch.candidates.push_back(trees.candidate(graph_.lattice, tile, edge));
        });
        std::sort(scratch.candidates.begin(), scratch.candidates.end());
        TreeJoiner<std::uint32_t>& joiner = scratch.joiner;
        joiner.begin(count);
        if (const auto source = unite_sources(trees, block, joiner, first)) joiner.freeze(*source - first);
        for (std::size_t k = 0; k < scratch.candidates.size(); ++k) {
            const CandidateEdge e = scratch.candidates[k];
            if (k + kAhead < scratch.candidates.size()) forest_.prefetch(node_of(scratch.candidates[k + kAhead]));
            if (is_own(e.a) != is_own(e.b)) {
                joiner.freeze((is_own(e.a) ? e.a : e.b) - first);
                if (is_own(e.a)) scratch.open.push_back(e);
                continue;
            }
            const EdgeFate fate = joiner.take(e.a - first, e.b - first);
            if (fate == EdgeFate::joins) add(e);
            if (fate == EdgeFate::stays_open) scratch.open.push_back(e);
        }
        for (std::uint32_t t = 0; t < count; ++t) tree[first + t] = first + joiner.root(t);
    }

    /// Unites the source trees of a block, counted from `first` on. One of them, if there are any.
    std::optional<std::uint32_t> unite_sources(const BlockedTrees& trees, int block, TreeJoiner<std::uint32_t>& joiner,
                                               std::uint32_t first) const {
        std::optional<std::uint32_t> source;
        trees.for_tiles(block, 0, [&](int tile) {
            const std::uint16_t in_tile = left_[std::size_t(tile)].source_tree;
            if (in_tile == kNoTree) return;
            const std::uint32_t t = trees.first_tree_of_tile(tile) + in_tile;
            if (source) joiner.unite(*source - first, t - first);
            source = t;
        });
        return source;
    }

    /// `open`: what blocks leave open, which is let go; `tree`: to which tree each of a block's trees came to belong.
    void take_rest(const BlockedTrees& trees, std::vector<std::vector<CandidateEdge>> open,
                   std::vector<std::uint32_t> tree) {
        std::vector<CandidateEdge> rest;
        rest.reserve(std::accumulate(open.begin(), open.end(), std::size_t{0},
                                     [](std::size_t sum, const auto& of_block) { return sum + of_block.size(); }));
        for (auto& of_block : open) {
            for (const CandidateEdge& e : of_block) rest.push_back({e.key, tree[e.a], tree[e.b]});
            of_block = std::vector<CandidateEdge>();
        }
        std::sort(rest.begin(), rest.end());
        TreeJoiner<std::uint32_t> joiner;
        joiner.begin(std::move(tree));
        std::optional<std::uint32_t> source;
        for (int block = 0; block < trees.count(); ++block) {
            const auto here = unite_sources(trees, block, joiner, 0);
            if (here && source) joiner.unite(*here, *source);
            if (here) source = here;
        }
        for (const CandidateEdge& e : rest)
            if (joiner.take(e.a, e.b) == EdgeFate::joins) add(e);
    }

    static std::uint32_t node_of(const CandidateEdge& e) { return std::uint32_t(e.key >> 2); }

    void add(const CandidateEdge& e) {
        const std::uint32_t width = std::uint32_t(graph_.lattice.extent().x), u = node_of(e);
        const std::size_t forward = e.key & 3;
        const Offset ahead = kForward[forward];
        forest_.add_step(u, kForwardStep[forward]);
        forest_.add_step(u + std::uint32_t(ahead.dy) * width + std::uint32_t(ahead.dx), kForwardStep[forward] ^ 1u);
    }

    /// Nodes come in no order: so many edges before one is taken the memory of its node is asked for.
    static constexpr std::size_t kAhead = 12;
    const WeightedLattice& graph_;
    const Tiling tiling_;
    const Work& work_;
    std::vector<std::vector<std::uint16_t>> sources_of_;  // of each tile, nodes of its window
    std::vector<TileRemainder> left_;
    Forest forest_;
};

}  // namespace

std::optional<Plan> plan_spanning_forest(const PlanRequest& request, const std::vector<Source>& sources,
                                         std::uint32_t largest_height, const Work& work) {
    const WeightedLattice& g = request.graph;
    constexpr std::uint32_t kLargestHeight = 65534;
    const bool both_ways = g.height_plane.empty() || g.symmetric;
    if (g.lattice.neighbourhood() == Neighbourhood::square16 || !both_ways || largest_height > kLargestHeight)
        return {};
    if (g.lattice.node_count() > kMostWalkedNodes) return {};
    Forest forest = ForestByTiles(g, sources, work).grown();
    return walk_forest(g, std::move(forest), sources, work);
}

}  // namespace dstylize
