#pragma once
#include <vector>

#include "pipeline/controls.h"

namespace dstylize {

/// Which connected part of the passable nodes each node belongs to, numbered in raster order of their
/// first nodes; kNone where nothing may grow.
struct PassableParts {
    static constexpr std::uint32_t kNone = 0xffffffffu;
    Grid<std::uint32_t> part;
    std::vector<std::uint32_t> size;  ///< nodes in each
};
PassableParts passable_parts(const WeightedLattice& graph);

/// The nodes from which growth starts, one owner each: the user's, or for every connected part of the
/// lattice the best place of the style's kind. Each is moved to the cheapest node within 8 u: with
/// max-sum a root on a dear node would make every path share that maximum.
/// Throws Error(bad_usage) for a root outside the picture or where nothing may grow, Error(failed)
/// when nothing may grow anywhere.
std::vector<NodeId> root_nodes(Fields& fields, const WeightedLattice& graph, const RootParameters& parameters,
                               const std::vector<RootChoice>& chosen, Extent picture_px);

}  // namespace dstylize
