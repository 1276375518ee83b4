#pragma once
#include <filesystem>
#include <string>

#include "graph/weighted_lattice.h"

namespace dstylize {

/// The kinds of maps: "portrait" is a sample picture scaled up, light = dear; "discs" is the same with a third of it
/// impassable; "65535 levels" and "32767 levels" have its fourth power; "noise" has nothing that neighbours share;
/// "constant" has ties everywhere; "maze" has walls. Of about so many million nodes, with weights 1..255 where the name
/// does not say otherwise.
WeightedLattice weight_map(const std::string& kind, double mega, Neighbourhood neighbourhood);

/// Where paths start on such a map: near the middle of its lower edge, not in a wall or disc.
NodeId map_source(const Lattice& lattice);

/// The weights, at most 255, as bytes, row by row.
void write_bytes(const WeightedLattice& graph, const std::filesystem::path& path);

}  // namespace dstylize
