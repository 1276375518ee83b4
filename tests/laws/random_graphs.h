#pragma once
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "core/grid.h"
#include "graph/planner.h"

namespace dstylize::test {

/// Random numbers that are the same everywhere: the standard fixes the engine, not its distributions.
class Dice {
  public:
    explicit Dice(std::uint32_t seed) : engine_(seed) {}
    /// Uniform enough for tests, in [0, n).
    std::uint32_t below(std::uint32_t n) { return std::uint32_t(engine_() % n); }
    int between(int lo, int hi) { return lo + int(below(std::uint32_t(hi - lo + 1))); }
    bool one_in(std::uint32_t n) { return below(n) == 0; }
    float unit() { return float(engine_() >> 8) * 0x1p-24f; }

  private:
    std::mt19937 engine_;
};

inline constexpr Metric kMetrics[] = {Metric::sum, Metric::max_sum, Metric::lexicographic, Metric::blend};

/// A grid on which every cell is passable.
inline Grid<std::uint8_t> open_ground(Extent e) { return Grid<std::uint8_t>(e, 1); }

struct RandomGraph {
    WeightedLattice graph;
    std::vector<Source> sources;
    std::string shape;  ///< for messages
};

/// A graph of a shape, weights, planes and sources that depend on the seed alone: 1 x N, all equal,
/// mazes, walls, few levels, weights to 65535, planes of either symmetry, built or plain random;
/// sources with start labels and owners, some of them twice.
RandomGraph random_graph(std::uint32_t seed, int largest_side);

/// Random weights, walls and sources of two owners on an irregular lattice, on half of them heights per direction.
RandomGraph random_graph_on(Lattice lattice, std::uint32_t seed);

/// All three columns; gtest's way to say no, with the message.
void expect_same_plan(const Plan& found, const Plan& expected, const std::string& what);

/// The nodes to which some path leads from a source.
std::vector<bool> reachable(const RandomGraph& g);

}  // namespace dstylize::test
