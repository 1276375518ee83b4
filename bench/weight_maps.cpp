#include "weight_maps.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "core/error.h"
#include "formats/files.h"
#include "formats/picture_codec.h"
#include "imaging/filters.h"

namespace dstylize {
namespace {

/// Cheap to compute, the same everywhere.
std::uint32_t hash(std::uint32_t x, std::uint32_t y, std::uint32_t salt) {
    std::uint32_t h = x * 0x9e3779b1u ^ y * 0x85ebca77u ^ salt * 0xc2b2ae3du;
    h = (h ^ h >> 15) * 0x2c1b3c6du;
    return h ^ h >> 12;
}

constexpr int kCell = 8, kCorridor = 6;  // of the maze

/// Each cell is open to the right or downwards.
NodeWeight maze(Extent extent, int i, int j) {
    const bool wall_x = i % kCell >= kCorridor, wall_y = j % kCell >= kCorridor;
    const bool last_x = i / kCell >= extent.x / kCell - 1, last_y = j / kCell >= extent.y / kCell - 1;
    const bool coin = hash(std::uint32_t(i / kCell), std::uint32_t(j / kCell), 3) % 2 == 0;
    const bool right = last_y || (!last_x && coin);
    return (wall_x && wall_y) || (wall_x && !right) || (wall_y && right) ? kImpassable : NodeWeight{20};
}

Grid<float> sample_luma() {
    constexpr std::uint64_t kMostBytes = 1u << 26;
    const std::string path = DSTYLIZE_SOURCE_DIR "/samples/portrait.png";
    return luma_plane(PictureCodec().decode(read_file(path, kMostBytes), path).picture);
}

/// `power` makes what is dark cheap beside the rest, for which 255 levels are too few.
std::vector<NodeWeight> portrait(const Grid<float>& luma, Extent extent, int levels, int power) {
    const Grid<float> large = resized(luma, extent);
    std::vector<NodeWeight> weight(large.size());
    for (std::size_t n = 0; n < weight.size(); ++n) {
        const float v = std::clamp(large[n], 0.f, 1.f);
        weight[n] = NodeWeight(1 + std::lround(float(levels - 1) * (power == 1 ? v : std::pow(v, float(power)))));
    }
    return weight;
}

void cut_disc(WeightedLattice& g, int x, int y, int radius) {
    const Extent e = g.lattice.extent();
    for (int j = std::max(0, y - radius); j <= std::min(e.y - 1, y + radius); ++j)
        for (int i = std::max(0, x - radius); i <= std::min(e.x - 1, x + radius); ++i)
            if ((i - x) * (i - x) + (j - y) * (j - y) <= radius * radius)
                g.weight[index(g.lattice.at(i, j))] = kImpassable;
}

/// A disc in each cell, but in the one where paths start.
void cut_discs(WeightedLattice& g) {
    constexpr int kDiscCell = 64, kLeastRadius = 8, kLargestRadius = 31;
    const Extent e = g.lattice.extent();
    const int source_i = g.lattice.column(map_source(g.lattice)), source_j = g.lattice.row(map_source(g.lattice));
    for (int j = 0; j < e.y; j += kDiscCell)
        for (int i = 0; i < e.x; i += kDiscCell) {
            if (i == source_i / kDiscCell * kDiscCell && j == source_j / kDiscCell * kDiscCell) continue;
            const std::uint32_t h = hash(std::uint32_t(i), std::uint32_t(j), 5);
            const int radius = kLeastRadius + int(h % (kLargestRadius - kLeastRadius + 1));
            const int spare = kDiscCell - 2 * radius;
            cut_disc(g, i + radius + int(h >> 8) % spare, j + radius + int(h >> 16) % spare, radius);
        }
}

}  // namespace

WeightedLattice weight_map(const std::string& kind, double mega, Neighbourhood neighbourhood) {
    static const Grid<float> luma = sample_luma();
    const double scale = std::sqrt(mega * 1e6 / double(luma.size()));
    const Extent extent{int(luma.extent().x * scale), int(luma.extent().y * scale)};
    WeightedLattice g;
    g.lattice = Lattice(extent, neighbourhood);
    if (kind == "portrait" || kind == "discs" || kind.ends_with(" levels")) {
        const bool more = kind.ends_with(" levels");
        g.weight = portrait(luma, extent, more ? std::stoi(kind) : 255, more ? 4 : 1);
        if (kind == "discs") cut_discs(g);
        return g;
    }
    g.weight.reserve(extent.count());
    for (int j = 0; j < extent.y; ++j)
        for (int i = 0; i < extent.x; ++i)
            g.weight.push_back(kind == "maze"    ? maze(extent, i, j)
                               : kind == "noise" ? NodeWeight(1 + hash(std::uint32_t(i), std::uint32_t(j), 2) % 255)
                                                 : NodeWeight{100});
    return g;
}

NodeId map_source(const Lattice& lattice) {
    const Extent e = lattice.extent();
    return lattice.at(e.x / 2 / kCell * kCell, (e.y / kCell - 3) * kCell);
}

void write_bytes(const WeightedLattice& graph, const std::filesystem::path& path) {
    const std::string bytes(graph.weight.begin(), graph.weight.end());
    std::ofstream file(path, std::ios::binary);
    if (!file.write(bytes.data(), std::streamsize(bytes.size())).flush())
        throw Error(ErrorCode::cannot_write, path.string(), "cannot be written", "");
}

}  // namespace dstylize
