#pragma once
#include <filesystem>
#include <string>

#include "graph/weighted_lattice.h"

namespace dstylize {

/// Weights 1..255 of about so many million nodes. Of the kinds, "portrait" is a sample picture scaled up,
/// light = dear; "noise" has nothing that neighbours share; "constant" has ties everywhere; "maze" has walls.
WeightedLattice weight_map(const std::string& kind, double mega, Neighbourhood neighbourhood);

/// Where paths start on such a map: near the middle of its lower edge, not in a wall.
NodeId map_source(const Lattice& lattice);

/// The weights as bytes, row by row.
void write_bytes(const WeightedLattice& graph, const std::filesystem::path& path);

}  // namespace dstylize
