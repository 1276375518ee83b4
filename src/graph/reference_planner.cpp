// The oracle of every other planner: best-first search with a binary heap, written to be read.
// One loop serves all metrics; metric.h says how each labels a path and ranks it.
#include <queue>
#include <vector>

#include "graph/detail_sources.h"
#include "graph/detail_turn_cost.h"
#include "graph/detail_wide_plan.h"
#include "graph/metric.h"
#include "graph/planner.h"

namespace dstylize {
namespace {

struct Candidate {
    Rank rank;
    NodeId node;
    friend auto operator<=>(const Candidate&, const Candidate&) = default;
};

template <class Order>
class BestFirstSearch {
  public:
    BestFirstSearch(const PlanRequest& request, Order order)
        : graph_(request.graph),
          order_(order),
          turn_cost_(request.graph.lattice, request.turn_penalty),
          plan_(node_count()),
          best_(node_count(), kWorst),
          settled_(node_count(), false) {
        for (const Source& s : distinct_sources(request)) offer(s.node, {0, s.start}, {}, s.owner);
    }

    Plan run(const Work& work) && {
        for (std::size_t count = 0; !heap_.empty(); ++count) {
            if (count % 65536 == 0) work.check();
            const NodeId u = heap_.top().node;
            heap_.pop();
            if (settled_[index(u)]) continue;
            settled_[index(u)] = true;
            offer_neighbours(u);
        }
        return std::move(plan_).finished();
    }

  private:
    static constexpr Rank kWorst{~std::uint64_t{0}, ~std::uint64_t{0}};
    std::size_t node_count() const { return graph_.lattice.node_count(); }

    void offer_neighbours(NodeId u) {
        for (int s = 0; s < graph_.degree(u); ++s) {
            const std::uint32_t height = graph_.height(u, s);
            if (height == 0) continue;
            const NodeId v = graph_.neighbour(u, s);
            const std::uint64_t cost = std::uint64_t(height) * graph_.length5(u, s);
            const PathEdge e{u, v, height, cost + turn_cost_(plan_.parent[index(u)], u, v, cost)};
            offer(e.to, order_.label(plan_.label[index(u)], e), e, plan_.owner[index(u)]);
        }
    }

    /// The first of equals stays. Nodes are settled in the order (rank, index), so among the neighbours
    /// that give a node its label the parent is the one with the smallest label, then index.
    void offer(NodeId v, PathLabel label, const PathEdge& e, std::uint16_t owner) {
        const Rank rank = order_.rank(label, e);
        if (settled_[index(v)] || rank >= best_[index(v)]) return;
        best_[index(v)] = rank;
        plan_.label[index(v)] = label;
        plan_.parent[index(v)] = e.from;
        plan_.owner[index(v)] = owner;
        heap_.push({rank, v});
    }

    const WeightedLattice& graph_;
    const Order order_;
    const TurnCost turn_cost_;
    WidePlan plan_;
    std::vector<Rank> best_;
    std::vector<bool> settled_;
    std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> heap_;
};

class ReferencePlanner final : public Planner {
  public:
    Plan plan(const PlanRequest& request, const Work& work) const override {
        if (request.turn_penalty > 0 && !request.graph.lattice.adjacency())
            throw Error(ErrorCode::bad_usage, "", "a turn penalty needs a lattice other than unmoved squares",
                        "take one whose edges are listed");
        switch (request.metric) {
            case Metric::sum: return BestFirstSearch(request, SumOrder{}).run(work);
            case Metric::max_sum: return BestFirstSearch(request, MaxSumOrder{}).run(work);
            case Metric::lexicographic: return BestFirstSearch(request, LexicographicOrder{}).run(work);
            case Metric::blend: return BestFirstSearch(request, BlendOrder{request.blend_factor}).run(work);
        }
        return {};
    }
};

}  // namespace

const Planner& reference_planner() {
    static const ReferencePlanner planner;
    return planner;
}

}  // namespace dstylize
