#include "graph/weighted_lattice.h"

namespace dstylize {
namespace {

/// Twice the mean weight of the nodes that the edge touches, 0 if one of them is impassable.
std::uint32_t height_from_weights(const WeightedLattice& g, NodeId from, NodeId to, Step s) {
    if (!g.passable(from) || !g.passable(to)) return 0;
    std::uint32_t sum = std::uint32_t(g.weight[index(from)]) + g.weight[index(to)];
    if (!is_knights_move(s)) return sum;
    for (const Offset o : passed_between(s)) {
        const NodeId beside = g.lattice.at(g.lattice.column(from) + o.dx, g.lattice.row(from) + o.dy);
        if (!g.passable(beside)) return 0;
        sum += g.weight[index(beside)];
    }
    return sum / 2;
}

}  // namespace

NodeId WeightedLattice::neighbour(NodeId from, int step) const {
    const Step s = lattice.steps()[std::size_t(step)];
    const int i = lattice.column(from) + s.dx, j = lattice.row(from) + s.dy;
    return lattice.extent().contains(i, j) ? lattice.at(i, j) : kNoNode;
}

std::uint32_t WeightedLattice::height(NodeId from, int step) const {
    const NodeId to = neighbour(from, step);
    if (to == kNoNode) return 0;
    if (height_plane.empty()) return height_from_weights(*this, from, to, lattice.steps()[std::size_t(step)]);
    if (!symmetric) return height_plane[std::size_t(step)][index(from)];
    return height_plane[std::size_t(step / 2)][index(step % 2 == 0 ? from : to)];
}

}  // namespace dstylize
