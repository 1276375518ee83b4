#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "core/lattice.h"

namespace dstylize {

/// A node's integer weight. 0: impassable, nothing may grow there. Styles use 1..255 levels by
/// default, at most 1..65535. *Important = cheap.*
using NodeWeight = std::uint16_t;
inline constexpr NodeWeight kImpassable = 0;

/// From one node to another of the lattice.
struct Offset {
    int dx = 0, dy = 0;
};
constexpr bool is_knights_move(Step s) { return s.dx * s.dx + s.dy * s.dy == 5; }
/// The two nodes between which a knight's move passes, seen from the node it leaves.
constexpr std::array<Offset, 2> passed_between(Step s) {
    if (s.dx * s.dx == 4) return {{{s.dx / 2, 0}, {s.dx / 2, s.dy}}};
    return {{{0, s.dy / 2}, {s.dx, s.dy / 2}}};
}

/// What a planner walks on: a lattice whose edges get a height h and a cost c = h * length5.
///
/// Node weights alone: h(u, v) = w(u) + w(v) (twice the papers' edge weight, which is the mean of the
/// two nodes); for a knight's move half the sum of the four nodes it touches (its ends and the two
/// nodes between which it passes), rounded down. An edge with an impassable end, or a knight's move
/// that touches an impassable node, does not exist.
///
/// Height planes: costs that depend on place *and* direction (flow, tropism). plane[s][u] is the height
/// of the edge that leaves u by step s; 0 means no such edge. Symmetric planes store even steps only:
/// the height of step s ^ 1 from v is that of step s from the node it leads to. Planes alone say which
/// edges exist; `weight` then only says on which nodes a source may lie. height_planes.h builds them.
///
/// An irregular lattice: h(u, v) = w(u) + w(v), or, when there is a height plane, its one plane with a
/// height per entry of the adjacency.
struct WeightedLattice {
    Lattice lattice;
    std::vector<NodeWeight> weight;                        ///< one per node
    std::vector<std::vector<std::uint16_t>> height_plane;  ///< empty, or one per stored step
    bool symmetric = true;                                 ///< planes: half of the steps are stored

    bool passable(NodeId n) const { return weight[index(n)] != kImpassable; }
    /// How many step numbers a node has: the lattice's steps, or the edges that an irregular one lists.
    int degree(NodeId from) const;
    /// Height of the edge that leaves `from` by step number `step`; 0 when there is none.
    std::uint32_t height(NodeId from, int step) const;
    /// 5 x the length of that edge.
    std::uint32_t length5(NodeId from, int step) const;
    /// The node that step number `step` leads to, or kNoNode outside the lattice.
    NodeId neighbour(NodeId from, int step) const;
};

}  // namespace dstylize
