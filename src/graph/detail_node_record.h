#pragma once
#include <cstdint>

#include "graph/plan.h"
#include "graph/weighted_lattice.h"

namespace dstylize {

/// A node's label takes shape in place, so that a walk touches one line of memory a node. Until it is reached `sum`
/// has its weight and `highest` the steps of its edges that are in the forest, a bit each, above kStepShift; then, its
/// label, kReached and the step that led to it.
using NodeRecord = LabelColumn::Narrow;
inline constexpr unsigned kStepShift = 24;
inline constexpr std::uint32_t kReached = 1u << (kStepShift - 1), kHighest = kReached - 1;

inline NodeRecord unreached(NodeWeight weight, std::uint8_t steps) {
    return {.sum = weight, .highest = std::uint32_t{steps} << kStepShift};
}
inline void add_step(NodeRecord& node, unsigned step) { node.highest |= 1u << (kStepShift + step); }

}  // namespace dstylize
