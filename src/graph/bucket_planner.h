#pragma once
#include "graph/planner.h"

namespace dstylize {

/// Best-first search with bucket queues and edges fixed at compile time, one thread, any lattice,
/// weights and planes; the reference's answer bit for bit. Requests whose labels do not fit its 64-bit
/// keys (sums beyond 2^46), those with a turn penalty, and `lexicographic` on irregular lattices some of whose edges
/// have no like back or whose lists are not in the order of nodes, go to the reference.
const Planner& bucket_planner();

}  // namespace dstylize
