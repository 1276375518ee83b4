#include "graph/listed_lattices.h"

#include <array>
#include <cassert>
#include <cstdlib>
#include <limits>
#include <memory>
#include <span>

#include "graph/detail_listing.h"
#include "graph/weighted_lattice.h"

namespace dstylize {
namespace {

/// Joins every node to those at the offsets of its row, in the order of their numbers, unless something is between.
template <class OffsetsOfRow>
Lattice joined(std::vector<Vec2f> position, const Grid<std::uint8_t>& passable, const OffsetsOfRow& offsets_of_row) {
    const Extent e = passable.extent();
    auto a = std::make_shared<Adjacency>();
    a->position_lattice = std::move(position);
    list_edges(*a, [&](std::uint32_t n, const auto& visit) {
        const int i = int(n % std::uint32_t(e.x)), j = int(n / std::uint32_t(e.x));
        for (const Offset o : offsets_of_row(j)) {
            if (!e.contains(i + o.dx, j + o.dy)) continue;
            const auto v = std::uint32_t((j + o.dy) * e.x + i + o.dx);
            // From the smaller node, so that both ways agree to the last bit.
            const Vec2f from = a->position_lattice[std::min(n, v)], to = a->position_lattice[std::max(n, v)];
            if (stays_inside(passable, from, to)) visit(v, length5_between(from, to));
        }
    });
    return Lattice(e, std::move(a));
}

}  // namespace

Lattice moved_squares(Neighbourhood neighbourhood, float jitter, const Grid<std::uint8_t>& passable, Noise noise,
                      const Work& work) {
    work.check();
    std::vector<Offset> offsets;
    for (const Step s : Lattice(passable.extent(), neighbourhood).steps()) offsets.push_back({s.dx, s.dy});
    const auto in_order = [](Offset a, Offset b) { return a.dy != b.dy ? a.dy < b.dy : a.dx < b.dx; };
    std::sort(offsets.begin(), offsets.end(), in_order);
    return joined(staggered_positions(passable.extent(), 0, jitter, noise), passable,
                  [&](int) { return std::span<const Offset>(offsets); });
}

Lattice hexagon_lattice(float jitter, const Grid<std::uint8_t>& passable, Noise noise, const Work& work) {
    work.check();
    static constexpr std::array<Offset, 6> kOfEvenRows{{{-1, -1}, {0, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}}};
    static constexpr std::array<Offset, 6> kOfOddRows{{{0, -1}, {1, -1}, {-1, 0}, {1, 0}, {0, 1}, {1, 1}}};
    return joined(staggered_positions(passable.extent(), kStagger, jitter, noise), passable,
                  [](int row) { return std::span<const Offset>(row % 2 == 0 ? kOfEvenRows : kOfOddRows); });
}

Lattice cube_lattice(Extent slice, int depth, CubeNeighbourhood neighbourhood) {
    constexpr std::array<std::uint8_t, 4> kLength5{0, 5, 7, 9};  // by how many coordinates change
    assert(depth >= 0 && std::int64_t{slice.y} * depth <= std::numeric_limits<int>::max());
    const int most = neighbourhood == CubeNeighbourhood::cube6 ? 1 : 3;
    const Extent sheet{slice.x, slice.y * depth};
    auto a = std::make_shared<Adjacency>();
    a->position_lattice = staggered_positions(sheet, 0, 0, Noise(0, Purpose::jitter));
    list_edges(*a, [&](std::uint32_t n, const auto& visit) {
        const int i = int(n) % slice.x, j = int(n) / slice.x % slice.y, k = int(n) / slice.x / slice.y;
        for (int dk = -1; dk <= 1; ++dk)
            for (int dj = -1; dj <= 1; ++dj)
                for (int di = -1; di <= 1; ++di) {
                    const int changed = std::abs(di) + std::abs(dj) + std::abs(dk);
                    if (changed == 0 || changed > most) continue;
                    if (!slice.contains(i + di, j + dj) || k + dk < 0 || k + dk >= depth) continue;
                    visit(std::uint32_t(((k + dk) * slice.y + j + dj) * slice.x + i + di),
                          kLength5[std::size_t(changed)]);
                }
    });
    return Lattice(sheet, std::move(a));
}

}  // namespace dstylize
