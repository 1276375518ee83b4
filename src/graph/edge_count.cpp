#include "graph/edge_count.h"

namespace dstylize {

Grid<std::uint16_t> edge_count(const WeightedLattice& graph, std::span<const NodeId> starts, std::uint16_t most) {
    const auto beyond = std::uint16_t(most + 1);
    Grid<std::uint16_t> count(graph.lattice.extent(), beyond);
    std::vector<NodeId> front, next;
    for (const NodeId start : starts) {
        if (count[index(start)] == 0) continue;
        count[index(start)] = 0;
        front.push_back(start);
    }
    for (std::uint16_t away = 1; away <= most && !front.empty(); ++away) {
        next.clear();
        for (const NodeId u : front)
            for (int s = 0; s < graph.degree(u); ++s) {
                if (graph.height(u, s) == 0) continue;
                const NodeId v = graph.neighbour(u, s);
                if (count[index(v)] <= away) continue;
                count[index(v)] = away;
                next.push_back(v);
            }
        front.swap(next);
    }
    return count;
}

}  // namespace dstylize
