#pragma once
#include <algorithm>
#include <chrono>
#include <vector>

#include "core/grid.h"
#include "graph/graph_distance.h"
#include "graph/planner.h"

// What the tables of planner_bench have in common.
namespace dstylize {

/// The least time of so many runs, a node, and what the last one gave.
template <class Run>
auto timed(std::size_t nodes, int times, double& nanoseconds, const Run& run) {
    nanoseconds = 1e30;
    for (;;) {
        const auto begin = std::chrono::steady_clock::now();
        auto result = run();
        const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - begin;
        nanoseconds = std::min(nanoseconds, took.count() / double(nodes));
        if (--times <= 0) return result;
    }
}

Plan planned(const Planner& planner, const PlanRequest& request, int threads, int times, double& nanoseconds);

/// What the stippling floods on the portrait, and how dear a stipple is.
Grid<float> stippling_expense(const WeightedLattice& portrait);
inline constexpr float kStipplingThreshold = 10;

std::vector<NodeId> stippled(const GraphDistanceRequest& request, int threads, int times, double& nanoseconds);

/// The benches fail where a figure misses its bar by more than this: machines are noisy.
inline constexpr double kTolerance = 0.85;
inline bool reaches(double value, double bar) { return value >= kTolerance * bar; }
inline bool stays_below(double value, double bar) { return value * kTolerance <= bar; }

}  // namespace dstylize
