// Heights per direction, in fixed point: base * factor, where the base height saturates at 16 bits and
// the factor has 16 bits, 10 of them behind the point, so that a product fits into 32 bits.
// With the flow's angle a, the step's angle t and the coherence c,
// 1 + A c sin^2(a - t) = 1 + A/2 (c - c cos 2a cos 2t - c sin 2a sin 2t), linear in (c, c cos 2a, c sin 2a).
#include "graph/height_planes.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
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

/// The steps of one stored plane.
struct Plane {
    Step step;
    std::uint32_t factor;     // of the step, kPoint
    std::int32_t cos2, sin2;  // of twice the step's angle, kAnglePoint
    Plane(Step s, float step_factor) : step(s) {
        const int squared = s.dx * s.dx + s.dy * s.dy, one = 1 << kAnglePoint;
        cos2 = (s.dx * s.dx - s.dy * s.dy) * one / squared;
        sin2 = 2 * s.dx * s.dy * one / squared;
        assert(step_factor > 0);
        factor = std::uint32_t(rounded(std::min(step_factor, DirectionalCost::kLargestFactor) * (1 << kPoint)));
    }
};

/// One row of one plane. Compile-time flags keep the loop free of branches, so that it is vectorised.
template <bool kKnight, bool kFlow>
void fill_row(const WeightedLattice& g, const QuantisedFlow& flow, const Plane& p, int row, std::uint16_t* plane) {
    const Extent e = g.lattice.extent();
    const int dx = p.step.dx, dy = p.step.dy;
    if (row + dy < 0 || row + dy >= e.y) return;
    const int first = std::max(0, -dx), count = std::min(e.x, e.x - dx) - first;
    const std::ptrdiff_t u = std::ptrdiff_t(row) * e.x + first, uv = std::ptrdiff_t(dy) * e.x + dx, v = u + uv;
    std::ptrdiff_t a = u, b = u;
    if constexpr (kKnight) {
        const auto [p0, p1] = passed_between(p.step);
        a = u + std::ptrdiff_t(p0.dy) * e.x + p0.dx;
        b = u + std::ptrdiff_t(p1.dy) * e.x + p1.dx;
    }
    const std::uint16_t* const w = g.weight.data();
    std::uint16_t* const out = plane + u;
    for (int i = 0; i < count; ++i) {
        std::uint32_t base = std::uint32_t(w[u + i]) + w[v + i];
        bool exists = (w[u + i] != kImpassable) & (w[v + i] != kImpassable);
        if constexpr (kKnight) {
            base = (base + w[a + i] + w[b + i]) / 2;
            exists &= (w[a + i] != kImpassable) & (w[b + i] != kImpassable);
        }
        std::uint32_t factor = p.factor;
        if constexpr (kFlow) {
            const std::int32_t across =
                (std::int32_t(flow.coherence[u + i]) + flow.coherence[v + i]) * (1 << kAnglePoint) -
                (std::int32_t(flow.cos2[u + i]) + flow.cos2[v + i]) * p.cos2 -
                (std::int32_t(flow.sin2[u + i]) + flow.sin2[v + i]) * p.sin2;
            // Rounding can leave `across` a hair below 0.
            const std::int32_t extra = (std::max(across, 0) + (1 << (kAnglePoint - 1))) >> kAnglePoint;
            factor = std::min((std::uint32_t(extra + (1 << kPoint)) * p.factor) >> kPoint, kLargestHeight);
        }
        const std::uint32_t height = (std::min(base, kLargestHeight) * factor + (1 << (kPoint - 1))) >> kPoint;
        out[i] = exists ? std::uint16_t(std::clamp(height, 1u, kLargestHeight)) : std::uint16_t{0};
    }
}

using FillRow = void (*)(const WeightedLattice&, const QuantisedFlow&, const Plane&, int, std::uint16_t*);
FillRow row_filler(bool knight, bool flow) {
    if (knight) return flow ? fill_row<true, true> : fill_row<true, false>;
    return flow ? fill_row<false, true> : fill_row<false, false>;
}

bool opposite_steps_are_equal(const std::vector<float>& factor) {
    for (std::size_t s = 0; s < factor.size(); s += 2)
        if (factor[s] != factor[s + 1]) return false;
    return true;
}

}  // namespace

std::vector<float> downward_bias(const Lattice& lattice, float down) {
    std::vector<float> factor;
    for (const Step s : lattice.steps()) {
        const float uy = float(s.dy) / std::sqrt(float(s.dx * s.dx + s.dy * s.dy));
        factor.push_back(1 + down * (1 - uy) / 2);
    }
    return factor;
}

void build_height_planes(WeightedLattice& g, const DirectionalCost& cost, const Work& work) {
    const auto steps = g.lattice.steps();
    assert(cost.flow.empty() || cost.flow.extent() == g.lattice.extent());
    assert(cost.step_factor.empty() || cost.step_factor.size() == steps.size());
    assert(g.weight.size() == g.lattice.node_count());
    work.check();
    g.symmetric = opposite_steps_are_equal(cost.step_factor);
    std::vector<Plane> planes;
    for (std::size_t s = 0; s < steps.size(); s += g.symmetric ? 2 : 1)
        planes.emplace_back(steps[s], cost.step_factor.empty() ? 1.f : cost.step_factor[s]);
    g.height_plane.resize(planes.size());

    tbb::task_arena arena(work.threads > 0 ? work.threads : tbb::task_arena::automatic);
    arena.execute([&] {
        const bool has_flow = !cost.flow.empty() && cost.strength > 0;
        const QuantisedFlow flow = has_flow ? QuantisedFlow(cost.flow, cost.strength) : QuantisedFlow();
        tbb::parallel_for(std::size_t{0}, planes.size(), [&](std::size_t p) {
            std::vector<std::uint16_t>& plane = g.height_plane[p];
            plane.assign(g.weight.size(), 0);
            const FillRow fill = row_filler(is_knights_move(planes[p].step), has_flow);
            tbb::parallel_for(0, g.lattice.extent().y, [&](int j) { fill(g, flow, planes[p], j, plane.data()); });
        });
    });
    work.check();
}

}  // namespace dstylize
