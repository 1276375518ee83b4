#pragma once
#include "graph/planner.h"

namespace dstylize {

/// Best-first search with bucket queues and edges fixed at compile time, one thread, any lattice,
/// weights and planes; the reference's answer bit for bit. Requests whose labels do not fit its 64-bit
/// keys (sums beyond 2^46), and `lexicographic` on irregular lattices, go to the reference.
const Planner& bucket_planner();

}  // namespace dstylize
