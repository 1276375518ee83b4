#pragma once
#include "core/lattice.h"
#include "core/noise.h"
#include "core/work.h"

namespace dstylize {

/// An irregular lattice on which no direction is favoured: one node per cell of `extent`, rows staggered
/// by half a step (a hexagonal lattice, 15 % taller, so that fields and nodes share their cells), each
/// node moved by up to half a step either way and joined to its 12 nearest, the other way round, too.
/// Edges that pass over a cell where `passable` is 0 are left out. Paths on it have none of the straight
/// runs and 45-degree turns of a square lattice. About 200 operations a node.
Lattice scattered_lattice(Extent extent, const Grid<std::uint8_t>& passable, Noise noise, const Work& work);

}  // namespace dstylize
