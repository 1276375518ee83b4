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

std::vector<NodeWeight> portrait(const Grid<float>& luma, Extent extent) {
    const Grid<float> large = resized(luma, extent);
    std::vector<NodeWeight> weight(large.size());
    for (std::size_t n = 0; n < weight.size(); ++n)
        weight[n] = NodeWeight(1 + std::lround(254 * std::clamp(large[n], 0.f, 1.f)));
    return weight;
}

}  // namespace

WeightedLattice weight_map(const std::string& kind, double mega, Neighbourhood neighbourhood) {
    static const Grid<float> luma = sample_luma();
    const double scale = std::sqrt(mega * 1e6 / double(luma.size()));
    const Extent extent{int(luma.extent().x * scale), int(luma.extent().y * scale)};
    WeightedLattice g;
    g.lattice = Lattice(extent, neighbourhood);
    if (kind == "portrait") {
        g.weight = portrait(luma, extent);
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
