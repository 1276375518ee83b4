// Heights per direction, in fixed point: base * factor, where the base height saturates at 16 bits and
// the factor has 16 bits, 10 of them behind the point, so that a product fits into 32 bits.
// With the flow's angle a, the step's angle t and the coherence c,
// 1 + A c sin^2(a - t) = 1 + A/2 (c - c cos 2a cos 2t - c sin 2a sin 2t), linear in (c, c cos 2a, c sin 2a).
#include "graph/height_planes.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace dstylize {
namespace {

constexpr int kPoint = 10;       // binary digits of a factor behind the point
constexpr int kAnglePoint = 14;  // the same for the cosine and sine of a step
constexpr std::uint32_t kLargestHeight = 65535;

std::int32_t rounded(float x) { return std::int32_t(x + (x < 0 ? -0.5f : 0.5f)); }

/// A/4 times coherence, coherence * cos 2a and coherence * sin 2a of each node, so that the sum of an
/// edge's two ends has the scale of A/2 times their mean.
struct QuantisedFlow {
    std::vector<std::int16_t> coherence, cos2, sin2;

    QuantisedFlow() = default;
    QuantisedFlow(const Grid<Vec2f>& flow, float strength)
        : coherence(flow.size()), cos2(flow.size()), sin2(flow.size()) {
        const float scale = std::clamp(strength, 0.f, DirectionalCost::kLargestFactor - 1) / 4 * (1 << kPoint);
        tbb::parallel_for(std::size_t{0}, std::size_t(flow.extent().y), [&](std::size_t j) {
            const std::size_t width = std::size_t(flow.extent().x);
            for (std::size_t n = j * width; n < (j + 1) * width; ++n) {
                const Vec2f f = flow[n];
                const float squared = dot(f, f), c = std::min(1.f, std::sqrt(squared)) * scale;
                if (!(squared > 0 && std::isfinite(squared))) continue;
                coherence[n] = std::int16_t(rounded(c));
                cos2[n] = std::int16_t(rounded(c * (f.x * f.x - f.y * f.y) / squared));
                sin2[n] = std::int16_t(rounded(c * (2 * f.x * f.y) / squared));
            }
        });
    }
};

/// What an edge's direction has to do with its height.
struct Bearing {
    std::uint16_t factor = 0;         // of the step, kPoint
    std::int16_t cos2 = 0, sin2 = 0;  // of twice the angle, kAnglePoint
    Bearing(std::int64_t dx, std::int64_t dy, float step_factor) {
        assert(step_factor > 0);
        factor = std::uint16_t(rounded(std::min(step_factor, DirectionalCost::kLargestFactor) * (1 << kPoint)));
        const std::int64_t squared = dx * dx + dy * dy, one = 1 << kAnglePoint;
        if (squared == 0) return;
        cos2 = std::int16_t((dx * dx - dy * dy) * one / squared);
        sin2 = std::int16_t(2 * dx * dy * one / squared);
    }
};

/// The steps of one stored plane.
struct HeightPlane {
    Step step;
    Bearing bearing;
    HeightPlane(Step s, float step_factor) : step(s), bearing(s.dx, s.dy, step_factor) {}
};

/// A piece of a row: short enough for buffers on the stack, which the compiler knows not to overlap with
/// anything, so that it vectorises the loops without asking.
constexpr int kPiece = 512;
using Piece = std::array<std::uint16_t, kPiece>;

std::uint16_t saturated(std::uint32_t x) { return std::uint16_t(std::min(x, kLargestHeight)); }

/// Base heights of `count` edges, 0 where there is none, from the weights of the nodes they touch.
void fill_base(const NodeWeight* u, const NodeWeight* v, int count, Piece& base) {
    for (std::size_t i = 0; i < std::size_t(count); ++i) {
        const bool exists = (u[i] != kImpassable) & (v[i] != kImpassable);
        base[i] = exists ? saturated(std::uint32_t(u[i]) + v[i]) : std::uint16_t{0};
    }
}
void fill_base(const NodeWeight* u, const NodeWeight* v, const NodeWeight* a, const NodeWeight* b, int count,
               Piece& base) {
    for (std::size_t i = 0; i < std::size_t(count); ++i) {
        const bool exists =
            (u[i] != kImpassable) & (v[i] != kImpassable) & (a[i] != kImpassable) & (b[i] != kImpassable);
        const std::uint32_t sum = std::uint32_t(u[i]) + v[i] + a[i] + b[i];
        base[i] = exists ? saturated(sum / 2) : std::uint16_t{0};
    }
}

/// Products of 16-bit numbers throughout: those every vector unit multiplies well. Sums of two quantised
/// components stay within 16 bits.
std::uint16_t crossing_factor(const QuantisedFlow& flow, std::ptrdiff_t u, std::ptrdiff_t v, const Bearing& b) {
    const auto coherence = std::int16_t(flow.coherence[u] + flow.coherence[v]);
    const auto cos2 = std::int16_t(flow.cos2[u] + flow.cos2[v]);
    const auto sin2 = std::int16_t(flow.sin2[u] + flow.sin2[v]);
    const std::int32_t across =
        std::int32_t(coherence) * (1 << kAnglePoint) - std::int32_t(cos2) * b.cos2 - std::int32_t(sin2) * b.sin2;
    // Rounding can leave it a hair below 0.
    const std::int32_t extra = (std::max(across, 0) + (1 << (kAnglePoint - 1))) >> kAnglePoint;
    return std::uint16_t(extra + (1 << kPoint));
}

std::uint16_t product(std::uint16_t factor, std::uint16_t other) {
    return saturated((std::uint32_t(factor) * other) >> kPoint);
}

/// 0 where there is no edge, else at least 1.
std::uint16_t height(std::uint16_t base, std::uint16_t factor) {
    const std::uint16_t present = base != 0;
    return std::max(saturated((std::uint32_t(base) * factor + (1 << (kPoint - 1))) >> kPoint), present);
}

void fill_factor(const QuantisedFlow& flow, const Bearing& bearing, std::ptrdiff_t u, std::ptrdiff_t v, int count,
                 Piece& factor) {
    for (std::ptrdiff_t i = 0; i < count; ++i) factor[std::size_t(i)] = crossing_factor(flow, u + i, v + i, bearing);
    if (bearing.factor == 1 << kPoint) return;
    for (std::size_t i = 0; i < std::size_t(count); ++i) factor[i] = product(factor[i], bearing.factor);
}

void fill_heights(const Piece& base, const Piece& factor, int count, std::uint16_t* out) {
    for (std::size_t i = 0; i < std::size_t(count); ++i) out[i] = height(base[i], factor[i]);
}

void fill_row(const WeightedLattice& g, const QuantisedFlow& flow, const HeightPlane& p, int row,
              std::uint16_t* plane) {
    const Extent e = g.lattice.extent();
    const int dx = p.step.dx, dy = p.step.dy;
    if (row + dy < 0 || row + dy >= e.y) return;
    const int first = std::max(0, -dx), end = std::min(e.x, e.x - dx);
    const auto away = [&](Offset o) { return std::ptrdiff_t(o.dy) * e.x + o.dx; };
    Piece base, factor;
    factor.fill(p.bearing.factor);
    for (int i = first; i < end; i += kPiece) {
        const int count = std::min(kPiece, end - i);
        const std::ptrdiff_t u = std::ptrdiff_t(row) * e.x + i, v = u + away({dx, dy});
        const NodeWeight* const w = g.weight.data() + u;
        if (is_knights_move(p.step)) {
            const auto [a, b] = passed_between(p.step);
            fill_base(w, w + (v - u), w + away(a), w + away(b), count, base);
        } else {
            fill_base(w, w + (v - u), count, base);
        }
        if (!flow.coherence.empty()) fill_factor(flow, p.bearing, u, v, count, factor);
        fill_heights(base, factor, count, plane + u);
    }
}

bool opposite_steps_are_equal(const std::vector<float>& factor) {
    for (std::size_t s = 0; s < factor.size(); s += 2)
        if (factor[s] != factor[s + 1]) return false;
    return true;
}

/// The heights of an irregular lattice's edges, one by one.
void list_heights(WeightedLattice& g, const DirectionalCost& cost, const QuantisedFlow& flow) {
    const Adjacency& a = *g.lattice.adjacency();
    g.symmetric = false;
    g.height_plane.assign(1, std::vector<std::uint16_t>(a.to.size(), 0));
    tbb::parallel_for(std::uint32_t{0}, std::uint32_t(g.weight.size()), [&](std::uint32_t u) {
        for (std::uint32_t e = a.first[u]; e < a.first[u + 1]; ++e) {
            const std::uint32_t v = a.to[e];
            if (g.weight[u] == kImpassable || g.weight[v] == kImpassable) continue;
            constexpr float kFinely = 1024;
            const Vec2f way = kFinely * (a.position_lattice[v] - a.position_lattice[u]);
            const Bearing bearing(rounded(way.x), rounded(way.y), cost.step_factor.empty() ? 1 : cost.step_factor[e]);
            std::uint16_t factor = bearing.factor;
            if (!flow.coherence.empty()) factor = product(crossing_factor(flow, u, v, bearing), factor);
            g.height_plane[0][e] = height(saturated(std::uint32_t(g.weight[u]) + g.weight[v]), factor);
        }
    });
}

/// A plane for every step that is stored.
void fill_planes(WeightedLattice& g, const DirectionalCost& cost, const QuantisedFlow& flow) {
    const auto steps = g.lattice.steps();
    g.symmetric = opposite_steps_are_equal(cost.step_factor);
    std::vector<HeightPlane> planes;
    for (std::size_t s = 0; s < steps.size(); s += g.symmetric ? 2 : 1)
        planes.emplace_back(steps[s], cost.step_factor.empty() ? 1.f : cost.step_factor[s]);
    g.height_plane.resize(planes.size());
    tbb::parallel_for(std::size_t{0}, planes.size(), [&](std::size_t p) {
        std::vector<std::uint16_t>& plane = g.height_plane[p];
        plane.assign(g.weight.size(), 0);
        tbb::parallel_for(0, g.lattice.extent().y, [&](int j) { fill_row(g, flow, planes[p], j, plane.data()); });
    });
}

}  // namespace

float pull_factor(Vec2f step, Vec2f pull) {
    const float strength = length(pull), walked = length(step);
    if (strength <= 0 || walked <= 0) return 1;
    return 1 + (strength - dot(step, pull) / walked) / 2;
}

std::vector<float> pull_factors(const Lattice& lattice, Vec2f pull) {
    std::vector<float> factor;
    for (const Step s : lattice.steps()) factor.push_back(pull_factor({float(s.dx), float(s.dy)}, pull));
    if (const Adjacency* a = lattice.adjacency()) {
        factor.resize(a->to.size());
        tbb::parallel_for(std::uint32_t{0}, std::uint32_t(lattice.node_count()), [&](std::uint32_t u) {
            for (std::uint32_t e = a->first[u]; e < a->first[u + 1]; ++e)
                factor[e] = pull_factor(a->position_lattice[a->to[e]] - a->position_lattice[u], pull);
        });
    }
    return factor;
}

std::vector<float> downward_bias(const Lattice& lattice, float down) {
    std::vector<float> factor;
    for (const Step s : lattice.steps()) {
        const float uy = float(s.dy) / std::sqrt(float(s.dx * s.dx + s.dy * s.dy));
        factor.push_back(1 + down * (1 - uy) / 2);
    }
    return factor;
}

void build_height_planes(WeightedLattice& g, const DirectionalCost& cost, const Work& work) {
    const Adjacency* const listed = g.lattice.adjacency();
    assert(cost.flow.empty() || cost.flow.extent() == g.lattice.extent());
    assert(cost.step_factor.empty() ||
           cost.step_factor.size() == (listed ? listed->to.size() : g.lattice.steps().size()));
    assert(g.weight.size() == g.lattice.node_count());
    work.check();
    tbb::task_arena arena(work.threads > 0 ? work.threads : tbb::task_arena::automatic);
    arena.execute([&] {
        const bool has_flow = !cost.flow.empty() && cost.strength > 0;
        const QuantisedFlow flow = has_flow ? QuantisedFlow(cost.flow, cost.strength) : QuantisedFlow();
        listed ? list_heights(g, cost, flow) : fill_planes(g, cost, flow);
    });
    work.check();
}

}  // namespace dstylize
