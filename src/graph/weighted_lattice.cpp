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

int WeightedLattice::degree(NodeId from) const {
    const Adjacency* a = lattice.adjacency();
    return a ? int(a->first[index(from) + 1] - a->first[index(from)]) : int(lattice.steps().size());
}

std::uint32_t WeightedLattice::length5(NodeId from, int step) const {
    const Adjacency* a = lattice.adjacency();
    return a ? a->length5[a->first[index(from)] + std::uint32_t(step)] : lattice.steps()[std::size_t(step)].length5;
}

NodeId WeightedLattice::neighbour(NodeId from, int step) const {
    if (const Adjacency* a = lattice.adjacency()) return NodeId{a->to[a->first[index(from)] + std::uint32_t(step)]};
    const Step s = lattice.steps()[std::size_t(step)];
    const int i = lattice.column(from) + s.dx, j = lattice.row(from) + s.dy;
    return lattice.extent().contains(i, j) ? lattice.at(i, j) : kNoNode;
}

std::uint32_t WeightedLattice::height(NodeId from, int step) const {
    const NodeId to = neighbour(from, step);
    if (to == kNoNode) return 0;
    if (const Adjacency* a = lattice.adjacency()) {
        if (!height_plane.empty()) return height_plane[0][a->first[index(from)] + std::uint32_t(step)];
        return passable(from) && passable(to) ? std::uint32_t(weight[index(from)]) + weight[index(to)] : 0;
    }
    if (height_plane.empty()) return height_from_weights(*this, from, to, lattice.steps()[std::size_t(step)]);
    if (!symmetric) return height_plane[std::size_t(step)][index(from)];
    return height_plane[std::size_t(step / 2)][index(step % 2 == 0 ? from : to)];
}

}  // namespace dstylize
