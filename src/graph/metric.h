#pragma once
#include <algorithm>
#include <compare>
#include <cstdint>

#include "graph/planner.h"

namespace dstylize {

/// One directed step of a path.
struct PathEdge {
    NodeId from = kNoNode, to = kNoNode;
    std::uint32_t height = 0;
    std::uint64_t cost = 0;
};

/// What the planners compare: the smaller rank is settled first.
struct Rank {
    std::uint64_t first = 0, second = 0;
    friend auto operator<=>(const Rank&, const Rank&) = default;
};

/// A path's label after one more edge.
inline PathLabel extended(PathLabel label, const PathEdge& e) {
    return {std::max(label.highest, e.height), label.sum + e.cost};
}

// The metrics as policies. `label` is the label at e.to of the path that ends with e; at a source it is
// the start label and e is the empty edge. For the first three a longer path always ranks after its own
// beginning, which is all that best-first search asks for; the last is Prim's, by the last edge alone.

struct SumOrder {
    PathLabel label(PathLabel before, const PathEdge& e) const { return {0, extended(before, e).sum}; }
    Rank rank(PathLabel label, const PathEdge&) const { return {label.sum, 0}; }
};

/// Partial non-scalar distance (Long & Mould 2009, s. 3.2).
struct MaxSumOrder {
    PathLabel label(PathLabel before, const PathEdge& e) const { return extended(before, e); }
    Rank rank(PathLabel label, const PathEdge&) const { return {label.highest, label.sum}; }
};

/// Long & Mould 2009, s. 5.1.
struct BlendOrder {
    std::uint64_t factor;
    PathLabel label(PathLabel before, const PathEdge& e) const { return extended(before, e); }
    Rank rank(PathLabel label, const PathEdge&) const { return {factor * label.highest + label.sum, label.highest}; }
};

/// Full non-scalar distance (Pai & Reissell 1998). With the total order (height, edge index) on edges
/// its best paths are those of the one minimum spanning tree, which grows by its smallest leaving edge
/// (Prim); so the last edge alone ranks. The argument holds for heights that depend on direction, too.
struct LexicographicOrder {
    PathLabel label(PathLabel before, const PathEdge& e) const { return {0, extended(before, e).sum}; }
    Rank rank(PathLabel, const PathEdge& e) const { return e.to == kNoNode ? Rank{} : Rank{e.height, edge_index(e)}; }
    /// Edges are counted by their smaller node, then by their larger one, whichever way they are walked.
    static std::uint64_t edge_index(const PathEdge& e) {
        const std::uint32_t a = std::min(index(e.from), index(e.to)), b = std::max(index(e.from), index(e.to));
        return std::uint64_t(a) << 32 | b;
    }
};

}  // namespace dstylize
