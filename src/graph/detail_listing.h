#pragma once
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/lattice.h"
#include "core/noise.h"
#include "core/sampling.h"

namespace dstylize {

/// By how much rows of hexagons stand to the left and to the right.
inline constexpr float kStagger = 0.25f;

/// Nodes in the middles of their cells, even rows moved to the left by `stagger` and odd ones to the right, then each
/// by up to `jitter` half steps either way, but not out of the frame.
inline std::vector<Vec2f> staggered_positions(Extent e, float stagger, float jitter, Noise noise) {
    constexpr float kMiddle = 0.5f, kRim = 0.02f;
    std::vector<Vec2f> out(e.count());
    tbb::parallel_for(0, e.y, [&](int j) {
        for (int i = 0; i < e.x; ++i) {
            const auto random = noise.block(std::uint64_t(j) << 32 | std::uint64_t(i));
            const auto in_cell = [&](std::uint32_t bits) {
                return kMiddle + jitter * (Noise::unit_of(bits) - kMiddle);
            };
            const float x = float(i) + (j % 2 == 0 ? -stagger : stagger) + in_cell(random[0]);
            const float y = float(j) + in_cell(random[1]);
            out[std::size_t(j) * std::size_t(e.x) + std::size_t(i)] = {std::clamp(x, kRim, float(e.x) - kRim),
                                                                       std::clamp(y, kRim, float(e.y) - kRim)};
        }
    });
    return out;
}

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

/// Lists the edges of all nodes: neighbours(n, visit) calls visit(to, length5) for each of node n's, twice the same, on
/// any thread.
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
