#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "graph/weighted_lattice.h"

namespace dstylize {

/// The side of a window: one bit per row, one per column.
inline constexpr int kWindow = 64;

/// How a lattice is cut into tiles. Each has a window of 64 x 64 nodes: its own in the middle and around
/// them a rim as wide as the longest step, of nodes that belong to its neighbours. So every edge
/// that leaves a tile's own nodes ends in its window, which may reach out of the lattice.
class Tiling {
  public:
    explicit Tiling(const Lattice& lattice)
        : extent_(lattice.extent()),
          rim_(lattice.neighbourhood() == Neighbourhood::square16 ? 2 : 1),
          columns_((extent_.x + side() - 1) / side()),
          rows_((extent_.y + side() - 1) / side()) {}
    int rim() const { return rim_; }
    int side() const { return kWindow - 2 * rim_; }
    int columns() const { return columns_; }
    int rows() const { return rows_; }
    int count() const { return columns_ * rows_; }
    /// Where in the lattice the window of a tile begins.
    Offset origin(int tile) const { return {tile % columns_ * side() - rim_, tile / columns_ * side() - rim_}; }
    int tile_of(int i, int j) const { return j / side() * columns_ + i / side(); }
    bool is_inside(int tile) const {
        const Offset o = origin(tile);
        return o.dx >= 0 && o.dy >= 0 && o.dx + kWindow <= extent_.x && o.dy + kWindow <= extent_.y;
    }
    /// The tile that lies dx, dy tiles away, or -1.
    int neighbour(int tile, int dx, int dy) const {
        const int x = tile % columns_ + dx, y = tile / columns_ + dy;
        return x >= 0 && y >= 0 && x < columns_ && y < rows_ ? y * columns_ + x : -1;
    }

  private:
    Extent extent_;
    int rim_, columns_, rows_;
};

/// Nodes of a tile whose labels fell since it was last visited, in rows and columns of its window.
struct Pending {
    std::uint32_t least = ~std::uint32_t{0}, largest = 0;
    std::uint64_t rows = 0, columns = 0;
    bool steep = false;  ///< labels beside it were seen to rise by more than 16 bits over a window
    void add(std::uint32_t least_label, std::uint32_t largest_label, std::uint64_t in_rows, std::uint64_t in_columns) {
        least = std::min(least, least_label);
        largest = std::max(largest, largest_label);
        rows |= in_rows;
        columns |= in_columns;
    }
    bool any() const { return rows != 0; }
};

/// What labels mean.
enum class TileRule {
    sum,                    ///< least sum of costs
    bottleneck,             ///< least highest edge
    sum_within_bottleneck,  ///< least sum over the edges u -> v with max(M(u), h) = M(v)
};

/// Labels that are to be brought to rest.
struct TileProblem {
    const WeightedLattice& graph;
    Tiling tiling;
    TileRule rule;
    bool wide;                            ///< 32-bit lanes throughout, as 16-bit ones would not do
    std::uint32_t largest_step;           ///< no edge adds more to a label (0 for `bottleneck`)
    std::span<std::uint32_t> sum;         ///< labels, one per node; ~0: unreached
    std::span<std::uint16_t> bottleneck;  ///< M: the labels of `bottleneck`; ~0: unreached

    std::uint32_t label(NodeId n) const { return rule == TileRule::bottleneck ? bottleneck[index(n)] : sum[index(n)]; }

    /// Whether edges cost the same both ways.
    bool symmetric() const { return graph.height_plane.empty() || graph.symmetric; }
    /// What a label can be above the smallest pending one and still be seen by a visit.
    static constexpr std::uint32_t kNarrowFar = 65535, kWideFar = std::uint32_t{1} << 30;
    /// Visits to tiles whose smallest pending label lies above would not keep labels within 32 bits.
    static constexpr std::uint32_t largest_base(bool by_wide_lanes) {
        return ~std::uint32_t{0} - 1 - (by_wide_lanes ? kWideFar : kNarrowFar);
    }
    std::uint32_t largest_base() const { return largest_base(wide); }

    /// Whether a visit takes 32-bit lanes: half as many at a time, but where labels rise steeply a tile of 16-bit ones
    /// would have to be visited two or three times as often.
    bool takes_wide_lanes(const Pending& job) const { return wide || (job.steep && job.least <= largest_base(true)); }
    /// Whether a label is beyond the sight of 16-bit lanes from a base below.
    bool is_steep(std::uint32_t base, std::uint32_t label) const {
        return largest_step >= kNarrowFar || label - base >= kNarrowFar - largest_step;
    }
};

template <class Lane>
struct TileWindow;

/// Memory of one thread. Each of the two is made when it is first needed.
struct TileScratch {
    TileScratch();
    ~TileScratch();
    std::unique_ptr<TileWindow<std::uint16_t>> narrow;
    std::unique_ptr<TileWindow<std::uint32_t>> wide;
};

/// One visit: what was pending before, and what is pending after it in the tile (the middle one of the
/// nine) and its neighbours, row by row.
struct TileVisit {
    int tile = 0;
    Pending job;
    std::array<Pending, 9> after{};
    std::uint64_t rows_relaxed = 0;
};

// The passes over many nodes, compiled for several instruction sets; the best one that the machine has
// is called.

/// Brings a tile's window to rest: no edge within reach of its 16 or 32 bits lowers a label any more.
void visit_tile(const TileProblem& problem, TileScratch& scratch, TileVisit& visit);

/// Labels at rest, whose parents are wanted. `bottleneck` is empty for `sum`; no edge costs more than `largest_step`.
struct ParentRequest {
    const WeightedLattice& graph;
    std::span<const std::uint32_t> sum;
    std::span<const std::uint16_t> bottleneck;
    std::uint32_t largest_step;
};
/// The step from its parent to each node of the rows, ParentColumn::kNoStep at unreached ones, in its place in `step`.
void find_parents(const ParentRequest& request, int first_row, int end_row, std::span<std::uint8_t> step);

/// Makes parents of a forest: where `step` has the steps of a node's edges (bit s: the edge by step s), writes the step
/// from its parent, which is the one neighbour along them with a smaller sum; where there is none, kNoStep. Whether all
/// these nodes' sums are below kUnreachedWord.
bool find_forest_parents(const Lattice& lattice, std::span<const std::uint32_t> sum, int first_row, int end_row,
                         std::span<std::uint8_t> step);

/// The largest of the values, 0 if there are none.
std::uint16_t largest_value(std::span<const std::uint16_t> values);

}  // namespace dstylize
