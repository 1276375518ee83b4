#pragma once
#include <array>
#include <cstdint>
#include <span>

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

/// A regular graph over a block of nodes. Edges are implied by the steps, never stored.
/// Node (i, j) is NodeId j * extent.x + i and sits at (i + 0.5, j + 0.5) in the lattice frame.
class Lattice {
  public:
    Lattice() = default;
    Lattice(Extent extent, Neighbourhood neighbourhood) : extent_(extent), neighbourhood_(neighbourhood) {}

    Extent extent() const { return extent_; }
    Neighbourhood neighbourhood() const { return neighbourhood_; }
    std::size_t node_count() const { return extent_.count(); }
    std::span<const Step> steps() const;

    NodeId at(int i, int j) const { return NodeId{std::uint32_t(j) * std::uint32_t(extent_.x) + std::uint32_t(i)}; }
    int column(NodeId n) const { return int(index(n) % std::uint32_t(extent_.x)); }
    int row(NodeId n) const { return int(index(n) / std::uint32_t(extent_.x)); }
    Vec2f position_lattice(NodeId n) const { return {float(column(n)) + 0.5f, float(row(n)) + 0.5f}; }
    /// The node whose cell holds the point, clamped into the lattice.
    NodeId nearest(Vec2f point_lattice) const;

  private:
    Extent extent_;
    Neighbourhood neighbourhood_ = Neighbourhood::square8;
};

}  // namespace dstylize
