#pragma once
#include <cstdint>
#include <limits>

namespace dstylize {

/// A lattice node. An enum so that it cannot be mixed up with a count or a dendrite index.
enum class NodeId : std::uint32_t {};
inline constexpr NodeId kNoNode{std::numeric_limits<std::uint32_t>::max()};
constexpr std::uint32_t index(NodeId n) { return static_cast<std::uint32_t>(n); }

}  // namespace dstylize
