#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "graph/weighted_lattice.h"

namespace dstylize {

/// Which steps stay inside the lattice, as bit masks: one look-up a column and one a row instead of
/// four comparisons a step.
class InsideSteps {
  public:
    explicit InsideSteps(const Lattice& lattice)
        : column_(std::size_t(lattice.extent().x), 0), row_(std::size_t(lattice.extent().y), 0) {
        const Extent e = lattice.extent();
        const auto steps = lattice.steps();
        for (std::size_t s = 0; s < steps.size(); ++s) {
            for (int i = 0; i < e.x; ++i) column_[std::size_t(i)] |= std::uint32_t(e.contains(i + steps[s].dx, 0)) << s;
            for (int j = 0; j < e.y; ++j) row_[std::size_t(j)] |= std::uint32_t(e.contains(0, j + steps[s].dy)) << s;
        }
    }
    std::uint32_t from(std::uint32_t node) const {
        const std::uint32_t width = std::uint32_t(column_.size());
        return column_[node % width] & row_[node / width];
    }

  private:
    std::vector<std::uint32_t> column_, row_;
};

/// What the two classes below share. They call visit(neighbour, height, step) for every edge that leaves
/// a node. The number of steps and where heights come from are fixed when the program is compiled:
/// this is the innermost loop of the fast planners.
template <int kSteps>
class EdgesOfNode {
  public:
    std::uint32_t length5(int step) const { return length5_[std::size_t(step)]; }

  protected:
    explicit EdgesOfNode(const WeightedLattice& g) : inside_(g.lattice) {
        const auto steps = g.lattice.steps();
        for (std::size_t s = 0; s < kSteps; ++s) {
            offset_[s] = steps[s].dy * g.lattice.extent().x + steps[s].dx;
            length5_[s] = steps[s].length5;
        }
    }
    InsideSteps inside_;
    std::array<std::int32_t, kSteps> offset_;

  private:
    std::array<std::uint32_t, kSteps> length5_;
};

template <int kSteps>
class EdgesByWeight : public EdgesOfNode<kSteps> {
  public:
    explicit EdgesByWeight(const WeightedLattice& g) : EdgesOfNode<kSteps>(g), weight_(g.weight.data()) {
        for (std::size_t s = 8; s < kSteps; ++s) {
            const auto [a, b] = passed_between(g.lattice.steps()[s]);
            beside_[s] = {a.dy * g.lattice.extent().x + a.dx, b.dy * g.lattice.extent().x + b.dx};
        }
    }
    template <class Visit>
    void operator()(std::uint32_t u, Visit visit) const {
        const std::uint32_t inside = this->inside_.from(u), own = weight_[u];
        for (int s = 0; s < kSteps; ++s) {
            if (!(inside >> s & 1)) continue;
            const std::uint32_t v = u + std::uint32_t(this->offset_[std::size_t(s)]), other = weight_[v];
            if (other == kImpassable) continue;
            std::uint32_t height = own + other;
            if (s >= 8) {
                const std::uint32_t a = weight_[u + std::uint32_t(beside_[std::size_t(s)][0])];
                const std::uint32_t b = weight_[u + std::uint32_t(beside_[std::size_t(s)][1])];
                if (a == kImpassable || b == kImpassable) continue;
                height = (height + a + b) / 2;
            }
            visit(v, height, s);
        }
    }

  private:
    const NodeWeight* weight_;
    std::array<std::array<std::int32_t, 2>, kSteps> beside_{};
};

/// Works on a copy of the planes in which a node's heights lie side by side: for the planes as they are
/// every node would touch twice as many cache lines.
template <int kSteps, bool kSymmetric>
class EdgesByPlane : public EdgesOfNode<kSteps> {
  public:
    explicit EdgesByPlane(const WeightedLattice& g) : EdgesOfNode<kSteps>(g), height_(g.lattice.node_count()) {
        constexpr std::size_t kBlock = 4096;
        for (std::size_t first = 0; first < height_.size(); first += kBlock)
            for (std::size_t p = 0; p < kPlanes; ++p)
                for (std::size_t n = first; n < std::min(first + kBlock, height_.size()); ++n)
                    height_[n][p] = g.height_plane[p][n];
    }
    template <class Visit>
    void operator()(std::uint32_t u, Visit visit) const {
        const std::uint32_t inside = this->inside_.from(u);
        for (std::size_t s = 0; s < kSteps; ++s) {
            if (!(inside >> s & 1)) continue;
            const std::uint32_t v = u + std::uint32_t(this->offset_[s]);
            const std::uint32_t height = kSymmetric ? height_[s % 2 == 0 ? u : v][s / 2] : height_[u][s];
            if (height != 0) visit(v, height, int(s));
        }
    }

  private:
    static constexpr std::size_t kPlanes = kSymmetric ? kSteps / 2 : kSteps;
    std::vector<std::array<std::uint16_t, kPlanes>> height_;
};

/// The edges of an irregular lattice, by node weights or by the height of each edge; a step's number is its place in
/// the whole adjacency.
template <bool kByHeight>
class ListedEdges {
  public:
    explicit ListedEdges(const WeightedLattice& g)
        : adjacency_(*g.lattice.adjacency()), value_(kByHeight ? g.height_plane[0].data() : g.weight.data()) {}
    std::uint32_t length5(int edge) const { return adjacency_.length5[std::size_t(edge)]; }
    template <class Visit>
    void operator()(std::uint32_t u, Visit visit) const {
        const std::uint32_t first = adjacency_.first[u], end = adjacency_.first[u + 1];
        const std::uint32_t own = kByHeight ? 0 : value_[u];
        if (!kByHeight && own == kImpassable) return;
        for (std::uint32_t e = first; e < end; ++e) {
            const std::uint32_t v = adjacency_.to[e], value = value_[kByHeight ? e : v];
            if (value != 0) visit(v, own + value, int(e));
        }
    }

  private:
    const Adjacency& adjacency_;
    const std::uint16_t* value_;
};

}  // namespace dstylize
