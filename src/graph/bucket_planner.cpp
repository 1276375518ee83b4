// Best-first search where a label is one 64-bit key and nodes wait in a RadixQueue.
// Every edge costs at least c_min, so a key grows by at least c_min with every step: nodes whose keys
// fall into one bucket of that width cannot improve each other and are settled in any order
// (Denardo & Fox 1979). Parents are the exact ones, because ties are decided by key, then index.
#include "graph/bucket_planner.h"

#include <algorithm>
#include <bit>
#include <vector>

#include "graph/detail_edge_range.h"
#include "graph/detail_heights.h"
#include "graph/detail_radix_queue.h"
#include "graph/detail_sources.h"
#include "graph/detail_spanning_tree.h"

namespace dstylize {
namespace {

constexpr std::uint64_t kNoKey = ~std::uint64_t{0};
constexpr int kHeightBits = 17;  // a height is at most 2 * 65535
constexpr int kSumBits = 64 - kHeightBits;

// A metric's labels as keys: ordered as the metric orders them. kShift is where the sum begins.
struct SumKeys {
    static constexpr int kShift = 0;
    std::uint64_t at_source(std::uint64_t start) const { return start; }
    std::uint64_t after(std::uint64_t key, std::uint32_t height, std::uint32_t length5) const {
        return key + std::uint64_t(height) * length5;
    }
    PathLabel label(std::uint64_t key) const { return {0, key}; }
};

struct MaxSumKeys {
    static constexpr int kShift = 0;
    std::uint64_t at_source(std::uint64_t start) const { return start; }
    std::uint64_t after(std::uint64_t key, std::uint32_t height, std::uint32_t length5) const {
        const std::uint64_t highest = std::uint64_t(height) << kSumBits, sum = (std::uint64_t{1} << kSumBits) - 1;
        return std::max(key & ~sum, highest) + (key & sum) + std::uint64_t(height) * length5;
    }
    PathLabel label(std::uint64_t key) const {
        return {std::uint32_t(key >> kSumBits), key << kHeightBits >> kHeightBits};
    }
};

struct BlendKeys {
    static constexpr int kShift = kHeightBits;
    std::uint64_t factor;
    std::uint64_t at_source(std::uint64_t start) const { return start << kHeightBits; }
    std::uint64_t after(std::uint64_t key, std::uint32_t height, std::uint32_t length5) const {
        const std::uint32_t before = std::uint32_t(key) % (1u << kHeightBits);
        const std::uint64_t rise = height > before ? height - before : 0;
        return key + ((factor * rise + std::uint64_t(height) * length5) << kHeightBits) + rise;
    }
    PathLabel label(std::uint64_t key) const {
        const std::uint32_t highest = std::uint32_t(key) % (1u << kHeightBits);
        return {highest, (key >> kHeightBits) - factor * highest};
    }
};

template <class Keys, class Edges>
class BucketSearch {
  public:
    BucketSearch(const PlanRequest& request, Keys keys, std::uint64_t least_edge_cost)
        : keys_(keys),
          edges_(request.graph),
          bucket_bits_(Keys::kShift + int(std::bit_width(least_edge_cost)) - 1),
          key_(request.graph.lattice.node_count(), kNoKey),
          parent_(key_.size(), kNoNode),
          owner_(key_.size(), Plan::kNoOwner) {
        for (const Source& s : distinct_sources(request)) {
            owner_[index(s.node)] = s.owner;
            key_[index(s.node)] = keys_.at_source(s.start);
            queue_.push({bucket(key_[index(s.node)]), index(s.node)});
        }
    }

    Plan run(const Work& work) && {
        const auto is_stale = [this](const RadixQueue::Entry& e) { return bucket(key_[e.node]) != e.priority; };
        std::vector<RadixQueue::Entry> least;
        for (std::size_t count = 0; queue_.take_least(least, is_stale); ++count) {
            if (count % 1024 == 0) work.check();
            for (const RadixQueue::Entry& e : least)
                if (!is_stale(e)) settle(e.node);
        }
        std::vector<PathLabel> label(key_.size());
        for (std::size_t n = 0; n < key_.size(); ++n)
            if (key_[n] != kNoKey) label[n] = keys_.label(key_[n]);
        return {std::move(label), std::move(parent_), std::move(owner_)};
    }

  private:
    std::uint64_t bucket(std::uint64_t key) const { return key >> bucket_bits_; }

    void settle(std::uint32_t u) {
        const std::uint64_t key = key_[u];
        if (parent_[u] != kNoNode) owner_[u] = owner_[index(parent_[u])];
        edges_(u, [&](std::uint32_t v, std::uint32_t height, int step) {
            const std::uint64_t reached = keys_.after(key, height, edges_.length5(step)), before = key_[v];
            if (reached > before) return;
            if (reached == before) {
                if (parent_[v] != kNoNode && precedes(u, index(parent_[v]))) parent_[v] = NodeId{u};
                return;
            }
            key_[v] = reached;
            parent_[v] = NodeId{u};
            if (bucket(reached) != bucket(before)) queue_.push({bucket(reached), v});
        });
    }
    bool precedes(std::uint32_t a, std::uint32_t b) const { return key_[a] != key_[b] ? key_[a] < key_[b] : a < b; }

    const Keys keys_;
    const Edges edges_;
    const int bucket_bits_;
    std::vector<std::uint64_t> key_;
    std::vector<NodeId> parent_;
    std::vector<std::uint16_t> owner_;
    RadixQueue queue_;
};

template <class Edges, class Keys>
Plan search(const PlanRequest& request, const Work& work, Keys keys, const EdgeRange& range) {
    return BucketSearch<Keys, Edges>(request, keys, range.least_cost).run(work);
}

constexpr int kListed = 0;  // in the place of a number of steps: an irregular lattice

template <int kSteps, class Edges>
Plan spanning_tree(const PlanRequest& request, const Work& work, std::uint32_t largest_height) {
    if constexpr (kSteps == kListed) {
        ListedEdgeIndex edge_index(request.graph.lattice);
        if (!edge_index.has_all()) return reference_planner().plan(request, work);
        return SpanningTree<ListedEdgeIndex, Edges>(request, std::move(edge_index), largest_height).run(work);
    } else {
        const StepEdgeIndex<kSteps> edge_index(request.graph.lattice);
        return SpanningTree<StepEdgeIndex<kSteps>, Edges>(request, edge_index, largest_height).run(work);
    }
}

template <int kSteps, class Edges>
Plan plan_with(const PlanRequest& request, const Work& work) {
    const EdgeRange range = edge_range(request.graph);
    std::uint64_t largest_start = 0;
    for (const Source& s : request.sources) largest_start = std::max(largest_start, s.start);
    std::uint64_t largest_sum = largest_start + request.graph.lattice.node_count() * range.largest_cost;
    if (request.metric == Metric::blend) largest_sum += std::uint64_t{request.blend_factor} * range.largest_height;
    if (largest_sum >= std::uint64_t{1} << (kSumBits - 1)) return reference_planner().plan(request, work);
    switch (request.metric) {
        case Metric::sum: return search<Edges>(request, work, SumKeys{}, range);
        case Metric::max_sum: return search<Edges>(request, work, MaxSumKeys{}, range);
        case Metric::blend: return search<Edges>(request, work, BlendKeys{request.blend_factor}, range);
        case Metric::lexicographic: return spanning_tree<kSteps, Edges>(request, work, range.largest_height);
    }
    return {};
}

template <int kSteps>
Plan plan_on(const PlanRequest& request, const Work& work) {
    if (request.graph.height_plane.empty()) return plan_with<kSteps, EdgesByWeight<kSteps>>(request, work);
    if (request.graph.symmetric) return plan_with<kSteps, EdgesByPlane<kSteps, true>>(request, work);
    return plan_with<kSteps, EdgesByPlane<kSteps, false>>(request, work);
}

class BucketPlanner final : public Planner {
  public:
    Plan plan(const PlanRequest& request, const Work& work) const override {
        work.check();
        if (request.turn_penalty > 0) return reference_planner().plan(request, work);
        if (request.graph.lattice.adjacency())
            return request.graph.height_plane.empty() ? plan_with<kListed, ListedEdges<false>>(request, work)
                                                      : plan_with<kListed, ListedEdges<true>>(request, work);
        switch (request.graph.lattice.neighbourhood()) {
            case Neighbourhood::square4: return plan_on<4>(request, work);
            case Neighbourhood::square8: return plan_on<8>(request, work);
            case Neighbourhood::square16: return plan_on<16>(request, work);
        }
        return {};
    }
};

}  // namespace

const Planner& bucket_planner() {
    static const BucketPlanner planner;
    return planner;
}

}  // namespace dstylize
