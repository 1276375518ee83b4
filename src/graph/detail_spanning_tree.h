#pragma once
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "graph/detail_edge_index.h"
#include "graph/detail_edge_queue.h"
#include "graph/detail_heights.h"
#include "graph/detail_sources.h"
#include "graph/detail_wide_plan.h"
#include "graph/planner.h"

namespace dstylize {

/// The `lexicographic` metric: the minimum spanning forest grown from all sources at once (Prim), by
/// the order (height, smaller node index, larger node index) of edges, the latter two as `EdgeIndex` has them.
template <class EdgeIndex, class Edges>
class SpanningTree {
  public:
    SpanningTree(const PlanRequest& request, EdgeIndex edge_index, std::uint32_t largest_height)
        : edges_(request.graph),
          edge_index_(std::move(edge_index)),
          least_(request.graph.lattice.node_count(), kNoEdge),
          queue_(largest_height),
          plan_(least_.size()) {
        const std::vector<Source> sources = distinct_sources(request);
        for (const Source& s : sources) {
            least_[index(s.node)] = kSettled;
            plan_.label[index(s.node)] = {0, s.start};
            plan_.owner[index(s.node)] = s.owner;
        }
        for (const Source& s : sources) offer_edges_of(index(s.node));
    }

    Plan run(const Work& work) && {
        const auto is_stale = [this](std::uint64_t edge) {
            return is_settled(edge_index_.smaller_node(edge)) && is_settled(edge_index_.larger_node(edge));
        };
        for (std::size_t count = 0;; ++count) {
            if (count % 65536 == 0) work.check();
            const auto e = queue_.pop(is_stale);
            if (!e) return std::move(plan_).finished();
            const std::uint32_t a = edge_index_.smaller_node(e->index), b = edge_index_.larger_node(e->index);
            const std::uint32_t from = is_settled(a) ? a : b, to = a + b - from;
            least_[to] = kSettled;
            plan_.label[to].sum = plan_.label[from].sum + std::uint64_t(e->height) * edge_index_.length5(e->index);
            plan_.parent[to] = NodeId{from};
            plan_.owner[to] = plan_.owner[from];
            offer_edges_of(to);
        }
    }

  private:
    static constexpr std::uint64_t kNoEdge = std::numeric_limits<std::uint64_t>::max(), kSettled = 0;
    bool is_settled(std::uint32_t n) const { return least_[n] == kSettled; }

    /// Of the edges that lead to a node only its least can come to be in the tree.
    void offer_edges_of(std::uint32_t u) {
        edges_(u, [&](std::uint32_t v, std::uint32_t height, int step) {
            const std::uint64_t edge = edge_index_.of(u, v, step);
            const std::uint64_t order = std::uint64_t{height} << 40 | edge;
            if (order >= least_[v]) return;
            least_[v] = order;
            queue_.push({height, edge});
        });
    }

    const Edges edges_;
    const EdgeIndex edge_index_;
    std::vector<std::uint64_t> least_;  // order of the least edge met so far
    EdgeQueue queue_;
    WidePlan plan_;
};

}  // namespace dstylize
