#pragma once
#include <functional>
#include <span>
#include <vector>

#include "core/dendrite.h"
#include "graph/planner.h"

namespace dstylize {

/// A dendrite that grows on a lattice, one stage after the other.
class Growth {
  public:
    explicit Growth(const Lattice& lattice);

    const Dendrite& dendrite() const { return dendrite_; }
    bool contains(NodeId node) const { return index_of_[index(node)] != kAbsent; }

    /// A new root at `node`; nothing when the node is already taken.
    void add_root(NodeId node, std::uint16_t owner);

    /// From here on paths join, and start from, only what the stages up to `last_shared` have grown and what
    /// is grown anew: a tree behind the tree, on the same trunk.
    void start_layer(std::uint8_t last_shared);

    /// Joins the paths back from the endpoints to the dendrite: each is followed until it meets a node
    /// that is already in it. Endpoints without a path are left out; returns how many were.
    /// Precondition: the plan's sources are nodes of the dendrite.
    /// `accept`, when given, sees each new path, endpoint first, without the node that it joins, and may
    /// refuse it.
    using Accept = std::function<bool(std::span<const NodeId> path)>;
    std::size_t graft(const Plan& plan, std::span<const NodeId> endpoints, std::uint8_t stage,
                      const Accept& accept = {});

    /// Every node of the dendrite, or of its present layer, as a source. `carry` in [0, 1] makes a later stage remember
    /// its way: a node starts at carry * (arc length to its root) * cost_per_step. On the first `bare` steps from the
    /// root a start costs more, up to 2.5 * bare * cost_per_step at the root itself: trunks without twigs.
    std::vector<Source> sources(double carry, double cost_per_step, double bare = 0) const;

  private:
    static constexpr std::uint32_t kAbsent = 0xffffffffu;
    Lattice lattice_;
    Dendrite dendrite_;
    std::vector<std::uint32_t> index_of_;  // by lattice node
};

/// Without the side branches that hang on a longer branch and are shorter (lattice steps) than
/// `least_length` says at their first node.
Dendrite without_spurs(const Dendrite& dendrite, const std::function<float(Vec2f)>& least_length);

}  // namespace dstylize
