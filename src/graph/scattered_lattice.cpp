#include "graph/scattered_lattice.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "graph/detail_listing.h"

namespace dstylize {
namespace {

constexpr int kNearest = 12;
using NearestNodes = std::vector<std::array<std::uint32_t, kNearest>>;  // unused places hold the node itself

struct Near {
    float squared;
    std::uint32_t node;
    bool operator<(const Near& o) const { return squared != o.squared ? squared < o.squared : node < o.node; }
};

/// The nearest nodes of node (i, j), nearest first, ties by number. Nodes leave their cells' middles by at
/// most 0.75, so that what lies more than `reach` cells away is farther than `reach` - 0.5.
void find_nearest(const std::vector<Vec2f>& position, Extent e, int i, int j, std::vector<Near>& near) {
    const std::uint32_t n = std::uint32_t(j) * std::uint32_t(e.x) + std::uint32_t(i);
    for (int reach = 3;; reach += 2) {
        near.clear();
        const int left = std::max(0, i - reach), right = std::min(e.x - 1, i + reach);
        const int top = std::max(0, j - reach), bottom = std::min(e.y - 1, j + reach);
        for (int y = top; y <= bottom; ++y)
            for (int x = left; x <= right; ++x) {
                const std::uint32_t v = std::uint32_t(y) * std::uint32_t(e.x) + std::uint32_t(x);
                const Vec2f d = position[v] - position[n];
                if (v != n) near.push_back({dot(d, d), v});
            }
        const auto wanted = std::min<std::size_t>(kNearest, near.size());
        std::partial_sort(near.begin(), near.begin() + std::ptrdiff_t(wanted), near.end());
        near.resize(wanted);
        const bool all = left == 0 && top == 0 && right == e.x - 1 && bottom == e.y - 1;
        const float sure = float(reach) - 0.5f;
        if (all || (wanted == kNearest && near.back().squared <= sure * sure)) return;
    }
}

NearestNodes nearest_nodes(const std::vector<Vec2f>& position, const Grid<std::uint8_t>& passable) {
    const Extent e = passable.extent();
    NearestNodes out(position.size());
    tbb::parallel_for(0, e.y, [&](int j) {
        std::vector<Near> near;
        for (int i = 0; i < e.x; ++i) {
            const std::size_t n = std::size_t(j) * std::size_t(e.x) + std::size_t(i);
            find_nearest(position, e, i, j, near);
            out[n].fill(std::uint32_t(n));
            for (std::size_t k = 0; k < near.size(); ++k)
                if (stays_inside(passable, position[n], position[near[k].node])) out[n][k] = near[k].node;
        }
    });
    return out;
}

/// Of every node a bit for each of its nearest that does not have it among its own.
std::vector<std::uint16_t> one_way_edges(const NearestNodes& nearest) {
    std::vector<std::uint16_t> out(nearest.size());
    tbb::parallel_for(std::uint32_t{0}, std::uint32_t(nearest.size()), [&](std::uint32_t n) {
        for (std::size_t k = 0; k < kNearest; ++k) {
            const auto& back = nearest[nearest[n][k]];
            if (std::find(back.begin(), back.end(), n) == back.end()) out[n] |= std::uint16_t(1u << k);
        }
    });
    return out;
}

}  // namespace

Lattice scattered_lattice(Extent e, const Grid<std::uint8_t>& passable, Noise noise, const Work& work) {
    work.check();
    auto a = std::make_shared<Adjacency>();
    a->position_lattice = staggered_positions(e, kStagger, 1, noise);
    const NearestNodes nearest = nearest_nodes(a->position_lattice, passable);
    const std::vector<std::uint16_t> one_way = one_way_edges(nearest);
    work.check();
    const auto each_edge = [&](auto visit) {
        for (std::uint32_t n = 0; n < nearest.size(); ++n)
            for (std::size_t k = 0; k < kNearest; ++k) {
                const std::uint32_t v = nearest[n][k];
                if (v == n) continue;
                visit(n, v);
                if (one_way[n] >> k & 1) visit(v, n);
            }
    };
    std::vector<std::uint32_t> end(nearest.size() + 1, 0);
    each_edge([&](std::uint32_t from, std::uint32_t) { ++end[from + 1]; });
    for (std::size_t n = 0; n < nearest.size(); ++n) end[n + 1] += end[n];
    a->first = end;
    a->to.resize(end.back());
    each_edge([&](std::uint32_t from, std::uint32_t to) { a->to[end[from]++] = to; });
    a->length5.resize(a->to.size());
    tbb::parallel_for(std::uint32_t{0}, std::uint32_t(nearest.size()), [&](std::uint32_t n) {
        std::sort(a->to.begin() + a->first[n], a->to.begin() + a->first[n + 1]);
        for (std::uint32_t k = a->first[n]; k < a->first[n + 1]; ++k)
            a->length5[k] = length5_between(a->position_lattice[n], a->position_lattice[a->to[k]]);
    });
    return Lattice(e, std::move(a));
}

}  // namespace dstylize
