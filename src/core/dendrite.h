#pragma once
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/ids.h"
#include "core/vec.h"

namespace dstylize {

/// A forest of least-cost paths as parallel arrays, one entry per kept node.
/// Invariant: parent[v] < v, or parent[v] == kRoot. So one forward loop visits parents first and one
/// backward loop visits children first; no recursion, no pointers.
struct Dendrite {
    static constexpr std::uint32_t kRoot = std::numeric_limits<std::uint32_t>::max();

    std::vector<NodeId> node;             ///< the lattice node it came from
    std::vector<Vec2f> position_lattice;  ///< where it is drawn, after smoothing; lattice frame
    std::vector<std::uint32_t> parent;
    std::vector<std::uint16_t> owner;  ///< which root it grew from
    std::vector<std::uint8_t> stage;   ///< the stage that added it, 0 first

    std::size_t size() const { return parent.size(); }
    bool is_root(std::uint32_t v) const { return parent[v] == kRoot; }
    /// Appends a node and returns its index. `parent_index` must be an existing index or kRoot.
    std::uint32_t add(NodeId n, Vec2f at_lattice, std::uint32_t parent_index, std::uint16_t owner_id,
                      std::uint8_t stage_number);
};

/// The first broken invariant in words, or an empty string. For tests and for files read from disk.
std::string first_fault(const Dendrite& dendrite);

}  // namespace dstylize
