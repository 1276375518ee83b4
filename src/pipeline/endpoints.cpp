// Endpoint rules. Whatever the rule, what it may not take is marked in one grid first: what is impassable,
// what lies too far from the structure.
#include "pipeline/endpoints.h"

#include <algorithm>
#include <cmath>

#include "graph/edge_count.h"
#include "graph/graph_distance.h"
#include "imaging/filters.h"
#include "stipple/poisson_discs.h"

namespace dstylize {
namespace {

/// From which node on several rounds count as noise of their own; the first is the stage's.
std::uint32_t substream(const EndpointView& view) { return view.stage + 256 * std::uint32_t(view.batch); }

/// The passable nodes that lie near enough to the structure.
Grid<std::uint8_t> allowed(const Fields& fields, const EndpointParameters& p, const EndpointView& view) {
    Grid<std::uint8_t> out = view.passable;
    if (p.within <= 0) return out;
    const auto most = std::uint16_t(std::clamp(std::lround(p.within * fields.u()), 1L, 60000L));
    const Grid<std::uint16_t> edges = edge_count(view.graph, view.drawn.node, most);
    for (std::size_t n = 0; n < out.size(); ++n) out[n] = out[n] && edges[n] <= most;
    return out;
}

Grid<float> endpoint_density(Fields& fields, const EndpointParameters& p) {
    const auto density = [&](float v) {
        const float toe = p.density_toe > 0 ? smoothstep(-0.5f * p.density_toe, p.density_toe, v) : 1;
        const float share = std::clamp(v, 0.0f, 1.0f);
        return (p.density_exponent == 1 ? share : std::pow(share, p.density_exponent)) * toe;
    };
    const Grid<float>& field = fields[p.density];
    if (p.density_blur > 0) return transformed(blurred(field, p.density_blur * fields.u()), density);
    return transformed(field, density);
}

/// Spacings of a batch: they fall geometrically to the last one's.
float spacing_factor(const EndpointParameters& p, const EndpointView& view) {
    if (p.first_spacing <= 1 || view.batches < 2) return 1;
    return std::pow(p.first_spacing, 1 - float(view.batch) / float(view.batches - 1));
}

std::vector<NodeId> discs(Fields& fields, const EndpointParameters& p, const EndpointView& view, std::uint64_t seed) {
    const float u = fields.u(), factor = spacing_factor(p, view);
    const Grid<float> density = endpoint_density(fields, p);
    const DiscRequest request{fields[p.priority],
                              density,
                              p.at_least,
                              p.jitter,
                              p.calm_spacing * u * factor,
                              p.dense_spacing * u * factor,
                              Noise(seed, Purpose::endpoints, substream(view))};
    const Grid<std::uint8_t> open = allowed(fields, p, view);
    Occupancy occupancy(fields.extent());
    std::transform(open.begin(), open.end(), occupancy.begin(), [](std::uint8_t o) { return std::uint8_t(!o); });
    if (p.keep_off > 0) {
        const auto width = std::uint32_t(fields.extent().x);
        for (const NodeId node : view.drawn.node) {
            const std::uint32_t n = index(node);
            occupy(occupancy, int(n % width), int(n / width), p.keep_off * disc_radius(request, request.priority[n]));
        }
    }
    std::vector<NodeId> out = poisson_discs(request, occupancy);
    if (p.most > 0 && out.size() > std::size_t(p.most)) out.resize(std::size_t(p.most));
    return out;
}

/// Stipples whose spacing runs from calm_spacing at density 0 to dense_spacing at density 1: the
/// distance between two is threshold / expense, and the expense is linear in the density (004 s. 4.2).
std::vector<NodeId> stipples(Fields& fields, const EndpointParameters& p, const EndpointView& view, const Work& work) {
    Grid<float> expense = endpoint_density(fields, p);
    const float least = std::min(1.0f, p.dense_spacing / p.calm_spacing);
    transform(expense, [&](float v) { return least + (1 - least) * v; });
    const Grid<std::uint8_t> open = allowed(fields, p, view);
    return graph_distance_stipples({expense, std::max(0.01f, p.dense_spacing * fields.u()), view.drawn.node, open},
                                   work);
}

/// One endpoint straight above every root, as far up as can be grown without a gap.
std::vector<NodeId> above_roots(const Fields& fields, const EndpointParameters& p, const EndpointView& view) {
    std::vector<NodeId> out;
    const Lattice& lattice = view.graph.lattice;
    for (std::uint32_t v = 0; v < view.drawn.size(); ++v) {
        if (!view.drawn.is_root(v)) continue;
        const int column = lattice.column(view.drawn.node[v]), root_row = lattice.row(view.drawn.node[v]);
        int row = root_row;
        for (int k = 0; k < int(p.reach * fields.u()); ++k) {
            if (row == 0 || !view.graph.passable(lattice.at(column, row - 1))) break;
            --row;
        }
        if (row != root_row) out.push_back(lattice.at(column, row));
    }
    return out;
}

}  // namespace

std::vector<NodeId> placed_endpoints(Fields& fields, const EndpointParameters& p, const EndpointView& view,
                                     std::uint64_t seed, const Work& work) {
    switch (p.rule) {
        case EndpointParameters::Rule::stipples: return stipples(fields, p, view, work);
        case EndpointParameters::Rule::discs: return discs(fields, p, view, seed);
        case EndpointParameters::Rule::above: return above_roots(fields, p, view);
    }
    return {};
}

}  // namespace dstylize
