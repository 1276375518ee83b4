#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/grid.h"
#include "core/ids.h"
#include "core/vec.h"

namespace dstylize {

/// Which nodes an edge joins. square16 adds the knight's moves, which take the staircases out of
/// long lines across flat areas.
enum class Neighbourhood { square4, square8, square16 };

/// One kind of step a path can take. Steps come in opposite pairs: step s ^ 1 undoes step s.
struct Step {
    std::int8_t dx, dy;
    /// 5 x length, rounded: 5 straight, 7 diagonal, 11 for a knight's move.
    std::uint8_t length5;
};

/// The edges of an irregular lattice, as arrays: those that leave node n are first[n] .. first[n + 1].
struct Adjacency {
    std::vector<Vec2f> position_lattice;  ///< of every node, near the cell that its number names
    std::vector<std::uint32_t> first;     ///< one more than nodes
    std::vector<std::uint32_t> to;        ///< per edge; both directions are listed
    std::vector<std::uint8_t> length5;    ///< per edge: 5 x length, rounded, at least 1
};

/// A graph over a block of cells with one node each. On a regular one edges are implied by the steps,
/// never stored, and node (i, j), NodeId j * extent.x + i, sits at (i + 0.5, j + 0.5) in the lattice
/// frame; an irregular one lists its edges and says where in the cells' neighbourhood its nodes sit.
class Lattice {
  public:
    Lattice() = default;
    Lattice(Extent extent, Neighbourhood neighbourhood) : extent_(extent), neighbourhood_(neighbourhood) {}
    /// An irregular lattice; `steps()` is empty then. graph/scattered_lattice.h and graph/listed_lattices.h make them.
    Lattice(Extent extent, std::shared_ptr<const Adjacency> adjacency)
        : extent_(extent), adjacency_(std::move(adjacency)) {}

    Extent extent() const { return extent_; }
    Neighbourhood neighbourhood() const { return neighbourhood_; }
    std::size_t node_count() const { return extent_.count(); }
    std::span<const Step> steps() const;
    /// Null on regular lattices.
    const Adjacency* adjacency() const { return adjacency_.get(); }

    NodeId at(int i, int j) const { return NodeId{std::uint32_t(j) * std::uint32_t(extent_.x) + std::uint32_t(i)}; }
    int column(NodeId n) const { return int(index(n) % std::uint32_t(extent_.x)); }
    int row(NodeId n) const { return int(index(n) / std::uint32_t(extent_.x)); }
    Vec2f position_lattice(NodeId n) const {
        if (adjacency_) return adjacency_->position_lattice[index(n)];
        return {float(column(n)) + 0.5f, float(row(n)) + 0.5f};
    }
    /// The node whose cell holds the point, clamped into the lattice.
    NodeId nearest(Vec2f point_lattice) const;

  private:
    Extent extent_;
    Neighbourhood neighbourhood_ = Neighbourhood::square8;
    std::shared_ptr<const Adjacency> adjacency_;
};

}  // namespace dstylize
