#pragma once
#include <cstdint>
#include <vector>

#include "core/branching.h"
#include "core/noise.h"
#include "core/parameters.h"

namespace dstylize {

/// How branches become smooth centrelines: the [stroke] table of a style. Lengths in u.
struct StrokeParameters {
    float smooth = 18;
    float junction = 5;
    float drop_spurs = 4, drop_spurs_light = 4;
    float warp = 0, warp_scale = 7;

    void visit(ParameterVisitor& visitor);
};

/// Smooths the whole tree at once, in place: every node moves half-way to the mean of its parent and
/// its main child, `passes` times; roots and tips stay. Branch starts move with their parents, so no
/// gaps open, and neighbours move together, so strokes do not cross.
void smooth(Dendrite& dendrite, const Branching& branching, int passes);

/// Displaces every node by bilinear value noise, keyed by its place in the picture: strokes kink where cells
/// meet, nothing comes apart, and neighbours move together. Two octaves: amplitude `warp` with cells of
/// `warp_scale`, and 1.5 times that with cells 2.7 times as large. `u`: lattice steps per u. Positions stay
/// inside the lattice.
void warp(Dendrite& dendrite, Extent lattice, const StrokeParameters& parameters, float u, std::uint64_t seed);

/// The centreline of a branch in the lattice frame. The first `lead` points run along the parent, so
/// that the branch leaves it tangentially instead of at a T.
struct Centreline {
    std::vector<Vec2f> points_lattice;
    std::uint32_t branch = 0;  ///< index into Branching::branches
    std::uint32_t lead = 0;
};

/// One centreline per branch. `junction_nodes`: how many of the parent's nodes lead in.
std::vector<Centreline> centrelines(const Dendrite& dendrite, const Branching& branching, int junction_nodes);

}  // namespace dstylize
