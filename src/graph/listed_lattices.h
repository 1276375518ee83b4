#pragma once
#include "core/lattice.h"
#include "core/noise.h"
#include "core/work.h"

namespace dstylize {

// Lattices of regular pattern whose edges are listed all the same, because their nodes are moved or because they
// fit no square (Camilleri 2016). Edges cost the weights of their two ends, knight's moves, too.

/// A square lattice each of whose nodes is moved by up to `jitter` half steps either way; edges are as long as
/// that makes them. Edges that pass over a cell where `passable` is 0 are left out. `jitter` in [0, 1].
Lattice moved_squares(Neighbourhood neighbourhood, float jitter, const Grid<std::uint8_t>& passable, Noise noise,
                      const Work& work);

/// Rows of nodes staggered by half a step, each joined to its six neighbours, 15 % taller than a hexagonal
/// lattice is, so that fields and nodes share their cells; `jitter` and `passable` as above. No two edges cross
/// while `jitter` is below 0.4.
Lattice hexagon_lattice(float jitter, const Grid<std::uint8_t>& passable, Noise noise, const Work& work);

/// To which nodes of a cube lattice an edge leads: over faces alone, or over edges and corners as well.
enum class CubeNeighbourhood { cube6, cube26 };

/// `depth` >= 0 slices of nodes in space, one below the other in the lattice frame: node (i, j) of slice k is
/// (i, k * slice.y + j) there. Lengths are 5, 7 and 9.
Lattice cube_lattice(Extent slice, int depth, CubeNeighbourhood neighbourhood);

}  // namespace dstylize
