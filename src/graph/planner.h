#pragma once
#include <cstdint>
#include <span>
#include <string_view>

#include "core/work.h"
#include "graph/plan.h"
#include "graph/weighted_lattice.h"

namespace dstylize {

/// The metrics by which paths are compared; metrics.def lists them, docs/method.md has their laws.
enum class Metric : std::uint8_t {
#define DSTYLIZE_METRIC(identifier, name) identifier,
#include "graph/metrics.def"
#undef DSTYLIZE_METRIC
};
std::span<const std::string_view> metric_names();

/// A node that paths may start from, with a start label (for `sum`: a part of its distance from the
/// root, so that later twigs leave at acute angles) and the colony it belongs to.
/// A source's label is (0, start). `sum` and `blend` may reach it strictly cheaper from another source:
/// then it is a node like any other, with a parent and the other's owner. `max-sum` and
/// `lexicographic` cannot, as every edge is higher than 0.
struct Source {
    NodeId node = kNoNode;
    std::uint64_t start = 0;  ///< at most kLargestStart
    std::uint16_t owner = 0;  ///< not Plan::kNoOwner
};

inline constexpr std::uint64_t kLargestStart = std::uint64_t{1} << 62;

struct PlanRequest {
    const WeightedLattice& graph;
    std::span<const Source> sources;  ///< a node named twice keeps its smallest start, then smallest owner
    Metric metric = Metric::max_sum;
    std::uint32_t blend_factor = 5000;  ///< k of `blend`: k * highest edge + sum
    /// A plan for the same graph and metric, without a turn penalty, or null, and the sources that it was made from.
    /// Saves time and never changes the answer: when sources come to those that there were, `sum` and the bottlenecks
    /// of `max-sum` only fall, and only what falls is searched again. Of no use where a source has gone or starts later
    /// now.
    const Plan* earlier = nullptr;
    std::span<const Source> earlier_sources{};
    /// In 1/256: an edge costs (1 - cos) / 2 times this share of its cost more, for the angle to the edge before it.
    /// Irregular lattices alone, and best-first search (the reference planner): a node keeps the path that reached it
    /// first, though another that arrives in a better direction might lead on for less. So S(v) is the least
    /// S(u) + c over the neighbours u, each with the parent that it has, and not the least of all paths. The paths of
    /// `lexicographic` are those of highest edges as ever.
    std::uint32_t turn_penalty = 0;
};

/// The seat of the planners. The reference planner is the oracle of every other one.
class Planner {
  public:
    virtual ~Planner() = default;
    /// Labels, parents and owners of all nodes. Throws Error(bad_usage) when there is no source or a
    /// source lies on an impassable node, or a turn penalty is set on a regular lattice; Error(cancelled).
    virtual Plan plan(const PlanRequest& request, const Work& work) const = 0;
};

/// A binary heap and one loop, written to be read: O(n log n).
const Planner& reference_planner();

}  // namespace dstylize
