#include <algorithm>

#include "graph/detail_edge_range.h"

namespace dstylize {

EdgeRange edge_range(const WeightedLattice& g) {
    std::uint32_t least = 65535, largest = 1;
    const auto look_at = [&](const std::vector<std::uint16_t>& values) {
        // Less 1, so that 0, which is no edge, becomes the largest: without a branch the compiler takes several at
        // once.
        std::uint16_t least_less_1 = 65534, high = 0;
        for (const std::uint16_t x : values) {
            least_less_1 = std::min(least_less_1, std::uint16_t(x - 1));
            high = std::max(high, x);
        }
        least = std::min(least, least_less_1 + 1u);
        largest = std::max(largest, std::uint32_t(high));
    };
    std::uint32_t shortest5 = 5, longest5 = 11;
    if (const Adjacency* a = g.lattice.adjacency(); a && !a->length5.empty()) {
        shortest5 = *std::min_element(a->length5.begin(), a->length5.end());
        longest5 = *std::max_element(a->length5.begin(), a->length5.end());
    }
    for (const auto& plane : g.height_plane) look_at(plane);
    if (g.height_plane.empty()) {
        look_at(g.weight);
        least *= 2;
        largest *= 2;
    }
    return {std::uint64_t(least) * shortest5, std::uint64_t(largest) * longest5, largest};
}

}  // namespace dstylize
