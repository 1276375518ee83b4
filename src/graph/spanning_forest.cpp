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
#include <algorithm>
#include <atomic>
#include <memory>
#include <numeric>

#include "graph/detail_forest_walk.h"
#include "graph/detail_spanning_forest.h"
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
        std::vector<CandidateEdge> candidates = all_candidates();
        work_.check();
        std::sort(candidates.begin(), candidates.end());
        join(candidates);
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
    std::vector<CandidateEdge> all_candidates() {
        std::vector<std::size_t> first_edge(forest_.size() + 1);
        first_tree_.resize(forest_.size() + 1);
        for (std::size_t t = 0; t < forest_.size(); ++t) {
            first_edge[t + 1] = first_edge[t] + forest_[t].open.size();
            first_tree_[t + 1] = first_tree_[t] + forest_[t].tree_count;
        }
        std::vector<CandidateEdge> candidates(first_edge.back());
        share_out(forest_.size(), work_, [&](std::size_t begin, std::size_t end) {
            for (std::size_t t = begin; t < end; ++t) {
                CandidateEdge* out = candidates.data() + first_edge[t];
                for (const OpenEdge& open : forest_[t].open) *out++ = candidate_of(int(t), open);
                forest_[t].open = {};
            }
        });
        return candidates;
    }

    CandidateEdge candidate_of(int tile, const OpenEdge& open) const {
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

    void join(const std::vector<CandidateEdge>& candidates) {
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
        for (const CandidateEdge& e : candidates) {
            const std::uint32_t a = root_of(joined.data(), e.a);
            const std::uint32_t b = root_of(joined.data(), e.b);
            if (a == b) continue;
            joined[b] = a;
            const std::uint32_t u = std::uint32_t(e.key >> 2);
            const std::size_t forward = e.key & 3;
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

}  // namespace

std::optional<Plan> plan_spanning_forest(const PlanRequest& request, const std::vector<Source>& sources,
                                         std::uint32_t largest_height, const Work& work) {
    const WeightedLattice& g = request.graph;
    constexpr std::uint32_t kLargestHeight = 65534;
    const bool both_ways = g.height_plane.empty() || g.symmetric;
    if (g.lattice.neighbourhood() == Neighbourhood::square16 || !both_ways || largest_height > kLargestHeight)
        return {};
    UnsetVector<NodeRecord> nodes = ForestByTiles(g, sources, work).unreached_nodes();
    return walk_forest(g, std::move(nodes), sources, work);
}

}  // namespace dstylize
