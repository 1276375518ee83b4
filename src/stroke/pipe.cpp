#include "stroke/pipe.h"

#include <algorithm>
#include <cmath>

#include "imaging/filters.h"

namespace dstylize {

void PipeParameters::visit(ParameterVisitor& v) {
    v.number({"tip", "u", "width of a single twig"}, tip, 0.05f, 10);
    v.number({"exponent", "", "width to this power adds up at forks: 2 thick boughs, 3 slender ones"}, exponent, 1, 6);
    v.number({"gain", "", "twigs' worth of width that every u of way adds"}, gain, 0, 1);
    v.number({"slender", "u", "widths above this are compressed"}, slender, 0.5f, 100);
    v.number({"widest", "u", "what they are compressed towards"}, widest, 1, 200);
    v.number({"flare", "", "how much wider the foot of the trunk is"}, flare, 0, 4);
    v.number({"flare_length", "u", "how far up that reaches"}, flare_length, 1, 400);
}

std::vector<float> pipe_widths(const Dendrite& d, const Branching& b, const PipeParameters& p, float u) {
    std::vector<float> way(d.size(), 0), out(d.size());
    for (std::uint32_t v = 0; v < d.size(); ++v)
        if (!d.is_root(v)) way[v] = way[d.parent[v]] + distance(d.position_lattice[v], d.position_lattice[d.parent[v]]);
    std::vector<double> pipes(d.size(), 0);
    for (std::size_t i = d.size(); i-- > 0;) {
        const auto v = std::uint32_t(i);
        if (b.main_child[v] == Branching::kNone) pipes[v] = 1;
        if (!d.is_root(v)) pipes[d.parent[v]] += pipes[v] + double(p.gain * (way[v] - way[d.parent[v]]) / u);
        float width = p.tip * std::pow(float(pipes[v]), 1 / p.exponent);
        if (const float room = p.widest - p.slender; width > p.slender && room > 0)
            width = p.slender + room * (1 - std::exp(-(width - p.slender) / room));
        const float up = way[v] / u;
        width *=
            1 + p.flare * (0.72f * std::exp(-up / p.flare_length) + 0.28f * std::exp(-up / (3.2f * p.flare_length)));
        out[v] = width * u;
    }
    return out;
}

Grid<float> ink_coverage(const Dendrite& d, const std::vector<float>& widths, Extent e, float sigma) {
    Grid<float> ink(e, 0.0f);
    const auto add = [&](Vec2f at, float amount) {
        ink(std::clamp(int(at.x), 0, e.x - 1), std::clamp(int(at.y), 0, e.y - 1)) += amount;
    };
    for (std::uint32_t v = 0; v < d.size(); ++v) {
        if (d.is_root(v)) continue;
        const Vec2f to = d.position_lattice[v], from = d.position_lattice[d.parent[v]];
        const Vec2f middle = lerp(from, to, 0.5f), across = normalized(perpendicular(to - from));
        const int lanes = std::max(1, int(widths[v] + 0.5f));
        const float amount = distance(from, to) * widths[v] / float(lanes);
        for (int k = 0; k < lanes; ++k) add(middle + across * (float(k) - 0.5f * float(lanes - 1)), amount);
    }
    ink = blurred(ink, sigma);
    transform(ink, [](float v) { return 1 - std::exp(-v); });
    return ink;
}

}  // namespace dstylize
