#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "graph/detail_edge_queue.h"
#include "graph/detail_heights.h"
#include "graph/detail_sources.h"
#include "graph/detail_wide_plan.h"
#include "graph/planner.h"

namespace dstylize {

/// The `lexicographic` metric: the minimum spanning forest grown from all sources at once (Prim), by
/// the order (height, smaller node index, larger node index) of edges. An edge's index is its smaller
/// node and the rank of the step from there, in the order of the nodes that the steps lead to.
template <int kSteps, class Edges>
class SpanningTree {
  public:
    SpanningTree(const PlanRequest& request, std::uint32_t largest_height)
        : edges_(request.graph),
          least_(request.graph.lattice.node_count(), kNoEdge),
          queue_(largest_height),
          plan_(least_.size()) {
        rank_steps(request.graph.lattice);
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
            return is_settled(smaller_node(edge)) && is_settled(larger_node(edge));
        };
        for (std::size_t count = 0;; ++count) {
            if (count % 65536 == 0) work.check();
            const auto e = queue_.pop(is_stale);
            if (!e) return std::move(plan_).finished();
            const std::uint32_t a = smaller_node(e->index), b = larger_node(e->index);
            const std::uint32_t from = is_settled(a) ? a : b, to = a + b - from;
            least_[to] = kSettled;
            plan_.label[to].sum =
                plan_.label[from].sum + std::uint64_t(e->height) * forward_[e->index % kRanks].length5;
            plan_.parent[to] = NodeId{from};
            plan_.owner[to] = plan_.owner[from];
            offer_edges_of(to);
        }
    }

  private:
    static constexpr std::uint64_t kNoEdge = std::numeric_limits<std::uint64_t>::max(), kSettled = 0;
    static constexpr std::uint32_t kRanks = 8;  // at least kSteps / 2
    struct Forward {
        std::uint32_t offset = 0;  // towards the larger node index
        std::uint32_t length5 = 0;
    };

    bool is_settled(std::uint32_t n) const { return least_[n] == kSettled; }
    std::uint32_t smaller_node(std::uint64_t edge) const { return std::uint32_t(edge / kRanks); }
    std::uint32_t larger_node(std::uint64_t edge) const { return smaller_node(edge) + forward_[edge % kRanks].offset; }

    void rank_steps(const Lattice& lattice) {
        const auto steps = lattice.steps();
        const auto before = [](Step a, Step b) { return a.dy != b.dy ? a.dy < b.dy : a.dx < b.dx; };
        const auto is_forward = [&](Step s) { return before({0, 0, 0}, s); };
        for (std::size_t s = 0; s < kSteps; ++s) {
            backward_[s] = !is_forward(steps[s]);
            const Step forward = backward_[s] ? steps[s ^ 1] : steps[s];
            for (const Step other : steps) rank_[s] += is_forward(other) && before(other, forward);
            forward_[rank_[s]] = {std::uint32_t(forward.dy * lattice.extent().x + forward.dx), forward.length5};
        }
    }

    /// Of the edges that lead to a node only its least can come to be in the tree.
    void offer_edges_of(std::uint32_t u) {
        edges_(u, [&](std::uint32_t v, std::uint32_t height, int step) {
            const std::uint64_t edge =
                std::uint64_t(backward_[std::size_t(step)] ? v : u) * kRanks + rank_[std::size_t(step)];
            const std::uint64_t order = std::uint64_t{height} << 40 | edge;
            if (order >= least_[v]) return;
            least_[v] = order;
            queue_.push({height, edge});
        });
    }

    const Edges edges_;
    std::array<bool, kSteps> backward_{};
    std::array<std::uint32_t, kSteps> rank_{};
    std::array<Forward, kRanks> forward_{};
    std::vector<std::uint64_t> least_;  // order of the least edge met so far
    EdgeQueue queue_;
    WidePlan plan_;
};

}  // namespace dstylize
