#pragma once
#include "graph/planner.h"

namespace dstylize {

/// Tile by tile, so that what is worked on lies in cache; the same answer as the others' bit for bit. `sum` and
/// `max-sum` on square lattices by vectors, up to 40 times as fast as the bucket planner; `lexicographic` on them
/// without knight's moves, where edges are as high both ways; `sum` on irregular lattices. Everything else goes to the
/// bucket planner: `blend`, a turn penalty, the other metrics on irregular lattices, heights above 65534 (but for
/// `sum`), sums that do not fit 32 bits. Uses `work.threads` threads.
const Planner& tile_planner();

/// What a plan took, to be counted instead of timed.
struct TileStats {
    std::uint64_t tiles = 0;         ///< that the lattice is cut into; 0 if the bucket planner did it
    std::uint64_t visits = 0;        ///< over all passes; 0 for `lexicographic`, whose tiles are visited once
    std::uint64_t rows_relaxed = 0;  ///< 64 nodes each, by vectors
};

/// The tile planner's plan, and how it came about.
Plan plan_by_tiles(const PlanRequest& request, const Work& work, TileStats& stats);

}  // namespace dstylize
