#include "core/dendrite.h"

namespace dstylize {

std::uint32_t Dendrite::add(NodeId n, Vec2f at_lattice, std::uint32_t parent_index, std::uint16_t owner_id,
                            std::uint8_t stage_number) {
    node.push_back(n);
    position_lattice.push_back(at_lattice);
    parent.push_back(parent_index);
    owner.push_back(owner_id);
    stage.push_back(stage_number);
    return std::uint32_t(size() - 1);
}

std::string first_fault(const Dendrite& d) {
    const std::size_t n = d.size();
    if (d.node.size() != n || d.position_lattice.size() != n || d.owner.size() != n || d.stage.size() != n)
        return "arrays of different lengths";
    for (std::size_t v = 0; v < n; ++v) {
        const std::uint32_t p = d.parent[v];
        if (p == Dendrite::kRoot) continue;
        if (p >= v) return "node " + std::to_string(v) + " comes before its parent";
        if (d.owner[p] != d.owner[v]) return "node " + std::to_string(v) + " has another owner than its parent";
        if (d.stage[p] > d.stage[v]) return "node " + std::to_string(v) + " is of an earlier stage than its parent";
    }
    return {};
}

}  // namespace dstylize
