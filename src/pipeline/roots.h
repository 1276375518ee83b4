#pragma once
#include <algorithm>
#include <vector>

#include "pipeline/controls.h"

namespace dstylize {

/// Which connected part of the passable nodes each node belongs to, numbered in raster order of their
/// first nodes; kNone where nothing may grow.
struct PassableParts {
    static constexpr std::uint32_t kNone = 0xffffffffu;
    /// Bounds of a part, in nodes.
    struct Box {
        int left = 1 << 30, top = 1 << 30, right = -1, bottom = -1;
        void add(int first, int last, int row) {
            left = std::min(left, first);
            top = std::min(top, row);
            right = std::max(right, last);
            bottom = std::max(bottom, row);
        }
    };
    Grid<std::uint32_t> part;
    std::vector<std::uint32_t> size;  ///< nodes in each
    std::vector<Box> box;
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
