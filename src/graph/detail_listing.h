#pragma once
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/lattice.h"
#include "core/sampling.h"

namespace dstylize {

/// 5 x the distance, rounded, as Adjacency has it.
inline std::uint8_t length5_between(Vec2f a, Vec2f b) {
    return std::uint8_t(std::clamp(5 * distance(a, b) + 0.5f, 1.0f, 255.0f));
}

/// Whether the way between two points keeps off cells where `passable` is 0.
inline bool stays_inside(const Grid<std::uint8_t>& passable, Vec2f a, Vec2f b) {
    constexpr int kPieces = 4;
    for (int k = 0; k <= kPieces; ++k)
        if (!sample(passable, lerp(a, b, float(k) / kPieces))) return false;
    return true;
}

/// Lists the edges of all nodes: neighbours(n, visit) calls visit(to, length5) for each of node n's.
template <class Neighbours>
void list_edges(Adjacency& a, const Neighbours& neighbours) {
    const auto nodes = std::uint32_t(a.position_lattice.size());
    a.first.assign(nodes + std::size_t{1}, 0);
    tbb::parallel_for(std::uint32_t{0}, nodes,
                      [&](std::uint32_t n) { neighbours(n, [&](std::uint32_t, std::uint8_t) { ++a.first[n + 1]; }); });
    for (std::uint32_t n = 0; n < nodes; ++n) a.first[n + 1] += a.first[n];
    a.to.resize(a.first[nodes]);
    a.length5.resize(a.first[nodes]);
    tbb::parallel_for(std::uint32_t{0}, nodes, [&](std::uint32_t n) {
        std::uint32_t e = a.first[n];
        neighbours(n, [&](std::uint32_t to, std::uint8_t length5) {
            a.to[e] = to;
            a.length5[e++] = length5;
        });
    });
}

}  // namespace dstylize
