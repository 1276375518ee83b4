#pragma once
#include <vector>

#include "core/grid.h"
#include "core/vec.h"
#include "core/work.h"
#include "graph/weighted_lattice.h"

namespace dstylize {

/// What makes an edge cost more in one direction than in another, besides the weights it joins.
struct DirectionalCost {
    /// Largest factor that flow and step together can put on a height; more saturates.
    static constexpr float kLargestFactor = 63;

    /// Empty, or one vector per node: along it edges are cheapest (its sign means nothing), and its
    /// length is the coherence, in [0, 1].
    Grid<Vec2f> flow;
    /// A >= 0: heights are multiplied by 1 + A * coherence * sin^2(angle between step and flow), the
    /// coherence and the flow being the mean of both ends'.
    float strength = 0;
    /// Empty, or one factor > 0 per step of a regular lattice, or per edge of an irregular one's adjacency.
    std::vector<float> step_factor;
};

/// How much dearer a step is for not going the way of `pull`: 1 along it, 1 + |pull| against it, walking
/// from the root to the tips (tropism, wind, gravity).
float pull_factor(Vec2f step, Vec2f pull);

/// That factor for every step of a regular lattice, or every edge of an irregular one's adjacency.
std::vector<float> pull_factors(const Lattice& lattice, Vec2f pull);

/// Step factors for growth that falls (lightning): 1 straight down, 1 + down straight up, walking from
/// the root to the tips.
std::vector<float> downward_bias(const Lattice& lattice, float down);

/// Fills `graph.height_plane` and `graph.symmetric` from `graph.weight`. A height is the one of the
/// node weights, saturated at 65535, times the factors above, rounded, in [1, 65535]; all in integers, with
/// factors in steps of 1/1024. Planes are symmetric where opposite steps have equal factors.
void build_height_planes(WeightedLattice& graph, const DirectionalCost& cost, const Work& work);

}  // namespace dstylize
