#include "stroke/strokes.h"

#include <algorithm>
#include <cmath>

namespace dstylize {

void StrokeParameters::visit(ParameterVisitor& v) {
    v.number({"smooth", "", "smoothing passes over the tree at 1024 nodes; 0 leaves the lattice's steps"}, smooth, 0,
             200);
    v.number({"junction", "u", "how far a branch runs along its parent before it leaves"}, junction, 0, 40);
    v.number({"drop_spurs", "u", "side branches shorter than this are dropped where the tone is dark"}, drop_spurs, 0,
             100);
    v.number({"drop_spurs_light", "u", "the same where the tone is light: thorns on contours"}, drop_spurs_light, 0,
             100);
    v.number({"warp", "u", "how far strokes are pushed about: kinks, as of lightning"}, warp, 0, 20);
    v.number({"warp_scale", "u", "distance between those kinks"}, warp_scale, 1, 100);
}

void smooth(Dendrite& d, const Branching& b, int passes) {
    std::vector<Vec2f> next = d.position_lattice;
    for (int pass = 0; pass < passes; ++pass) {
        for (std::uint32_t v = 0; v < d.size(); ++v) {
            const std::uint32_t child = b.main_child[v];
            if (d.is_root(v) || child == Branching::kNone) continue;
            const Vec2f mean = 0.5f * (d.position_lattice[d.parent[v]] + d.position_lattice[child]);
            next[v] = lerp(d.position_lattice[v], mean, 0.5f);
        }
        std::swap(d.position_lattice, next);
    }
}

namespace {

/// Value noise of unit amplitude, bilinear between the corners of square cells.
Vec2f value_noise(const Noise& noise, Vec2f at_cells) {
    const float x = std::floor(at_cells.x), y = std::floor(at_cells.y);
    const auto corner = [&](int i, int j) {
        const auto bits = noise.block(std::uint64_t(std::uint32_t(int(y) + j)) << 32 | std::uint32_t(int(x) + i));
        const auto unit = [](std::uint32_t b) { return 2 * Noise::unit_of(b) - 1; };
        return Vec2f{unit(bits[0]), unit(bits[1])};
    };
    const float fx = at_cells.x - x, fy = at_cells.y - y;
    return lerp(lerp(corner(0, 0), corner(1, 0), fx), lerp(corner(0, 1), corner(1, 1), fx), fy);
}

}  // namespace

void warp(Dendrite& d, Extent lattice, const StrokeParameters& p, float u, std::uint64_t seed) {
    constexpr float kCoarser = 2.7f, kCoarseAmplitude = 1.5f;
    if (p.warp <= 0) return;
    const Noise fine(seed, Purpose::warp, 0), coarse(seed, Purpose::warp, 1);
    const float cell = p.warp_scale * u, amplitude = p.warp * u;
    for (Vec2f& at : d.position_lattice) {
        const Vec2f pushed = at + value_noise(fine, at * (1 / cell)) * amplitude +
                             value_noise(coarse, at * (1 / (kCoarser * cell))) * (kCoarseAmplitude * amplitude);
        at = {std::clamp(pushed.x, 0.0f, float(lattice.x)), std::clamp(pushed.y, 0.0f, float(lattice.y))};
    }
}

namespace {

/// Binomial smoothing of the start of a line; its first point stays.
void relax_start(std::vector<Vec2f>& points, std::size_t reach) {
    constexpr int kPasses = 10;
    if (points.size() < 3) return;
    reach = std::min(reach, points.size() - 2);
    for (int pass = 0; pass < kPasses; ++pass) {
        Vec2f before = points[0];
        for (std::size_t k = 1; k <= reach; ++k) {
            const Vec2f here = points[k];
            points[k] = 0.5f * here + 0.25f * (before + points[k + 1]);
            before = here;
        }
    }
}

}  // namespace

std::vector<Centreline> centrelines(const Dendrite& d, const Branching& b, int junction_nodes) {
    std::vector<Centreline> out(b.branches.size());
    for (std::uint32_t id = 0; id < out.size(); ++id) {
        const Branch& branch = b.branches[id];
        Centreline& line = out[id];
        line.branch = id;
        if (branch.parent_branch != Branch::kNone) {
            for (std::uint32_t v = branch.nodes[0]; int(line.lead) < junction_nodes && !d.is_root(v); ++line.lead) {
                v = d.parent[v];
                line.points_lattice.push_back(d.position_lattice[v]);
            }
            std::reverse(line.points_lattice.begin(), line.points_lattice.end());
        }
        for (const std::uint32_t v : branch.nodes) line.points_lattice.push_back(d.position_lattice[v]);
        if (line.lead > 0) relax_start(line.points_lattice, line.lead + 2 * std::size_t(junction_nodes));
    }
    return out;
}

}  // namespace dstylize
