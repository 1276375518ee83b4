#include "pipeline/growth.h"

#include <algorithm>
#include <cmath>

#include "core/sampling.h"
#include "dendrite/graft.h"
#include "graph/bucket_planner.h"
#include "graph/graph_distance.h"
#include "graph/height_planes.h"
#include "graph/meeting_points.h"
#include "imaging/filters.h"
#include "pipeline/roots.h"
#include "stipple/poisson_discs.h"

namespace dstylize {
namespace {

/// Node weights of a stage (METHOD: cost = (sum of weighted fields)^power, in integer levels).
WeightedLattice weights(Fields& fields, const Grid<std::uint8_t>& passable, const Style& style,
                        const StageParameters& stage, const Work& work) {
    WeightedLattice graph{Lattice(fields.extent(), style.lattice.neighbourhood), {}, {}, true};
    Grid<float> cost(fields.extent(), stage.cost_constant);
    for (const auto& [name, weight] : stage.cost) {
        const Grid<float>& field = fields[name];
        for (std::size_t n = 0; n < cost.size(); ++n) cost[n] += weight * field[n];
    }
    graph.weight.resize(cost.size());
    const auto top = float(stage.levels - 1);
    for (std::size_t n = 0; n < cost.size(); ++n) {
        if (!passable[n]) continue;
        float c = std::max(0.0f, cost[n]);
        if (stage.cost_power != 1) c = std::pow(c, stage.cost_power);
        graph.weight[n] = NodeWeight(1 + std::lround(top * std::min(1.0f, c / stage.cost_max)));
    }
    if (stage.along_flow > 0 || stage.down > 0) {
        DirectionalCost directional;
        if (stage.along_flow > 0) directional.flow = fields.flow();
        directional.strength = stage.along_flow;
        if (stage.down > 0) directional.step_factor = downward_bias(graph.lattice, stage.down);
        build_height_planes(graph, directional, work);
    }
    return graph;
}

Grid<float> endpoint_density(Fields& fields, const EndpointParameters& p) {
    Grid<float> density =
        p.density_blur > 0 ? blurred(fields[p.density], p.density_blur * fields.u()) : fields[p.density];
    transform(density, [&](float v) {
        const float toe = p.density_toe > 0 ? smoothstep(-0.5f * p.density_toe, p.density_toe, v) : 1;
        return std::pow(std::clamp(v, 0.0f, 1.0f), p.density_exponent) * toe;
    });
    return density;
}

std::vector<NodeId> discs(Fields& fields, const Grid<std::uint8_t>& passable, const EndpointParameters& p,
                          const Dendrite& drawn, std::uint64_t seed, std::uint32_t stage_number) {
    const float u = fields.u();
    const Grid<float> density = endpoint_density(fields, p);
    const DiscRequest request{fields[p.priority],
                              density,
                              p.at_least,
                              p.jitter,
                              p.calm_spacing * u,
                              p.dense_spacing * u,
                              Noise(seed, Purpose::endpoints, stage_number)};
    Occupancy occupancy(fields.extent());
    std::transform(passable.begin(), passable.end(), occupancy.begin(),
                   [](std::uint8_t p0) { return std::uint8_t(!p0); });
    if (p.keep_off > 0) {
        const auto width = std::uint32_t(fields.extent().x);
        for (const NodeId node : drawn.node) {
            const std::uint32_t n = index(node);
            occupy(occupancy, int(n % width), int(n / width), p.keep_off * disc_radius(request, request.priority[n]));
        }
    }
    return poisson_discs(request, occupancy);
}

/// Stipples whose spacing runs from calm_spacing at density 0 to dense_spacing at density 1: the
/// distance between two is threshold / expense, and the expense is linear in the density (004 s. 4.2).
std::vector<NodeId> stipples(Fields& fields, const Grid<std::uint8_t>& passable, const EndpointParameters& p,
                             const Dendrite& drawn, const Work& work) {
    Grid<float> expense = endpoint_density(fields, p);
    const float least = std::min(1.0f, p.dense_spacing / p.calm_spacing);
    transform(expense, [&](float v) { return least + (1 - least) * v; });
    return graph_distance_stipples({expense, std::max(0.01f, p.dense_spacing * fields.u()), drawn.node, passable},
                                   work);
}

std::vector<NodeId> given_endpoints(const Controls& controls, const StageParameters& stage, bool first,
                                    const WeightedLattice& graph, Extent picture_px) {
    std::vector<NodeId> out;
    const Extent e = graph.lattice.extent();
    for (const EndpointRow& row : controls.endpoints) {
        if (row.stage.empty() ? !first : row.stage != stage.name) continue;
        const NodeId node = graph.lattice.nearest(
            {float(row.x.px(picture_px.x) / picture_px.x * e.x), float(row.y.px(picture_px.y) / picture_px.y * e.y)});
        if (graph.passable(node)) out.push_back(node);
    }
    return out;
}

/// The endpoints that close the rings of the priority field's ridges.
std::vector<NodeId> loop_closings(Fields& fields, const WeightedLattice& graph, const Plan& plan,
                                  const EndpointParameters& p) {
    constexpr float kApart = 0.16f;  // of the shortest way around
    const Grid<float>& ridge = fields[p.priority];
    Grid<std::uint8_t> candidate(ridge.extent());
    for (std::size_t n = 0; n < ridge.size(); ++n)
        candidate[n] = ridge[n] >= p.at_least && graph.weight[n] != kImpassable;
    const float around = p.close_loops * fields.u();
    return meeting_points(graph.lattice, plan, candidate, std::max(1, int(around)), kApart * around);
}

double mean_cost_per_step(const WeightedLattice& graph, const Dendrite& drawn) {
    double sum = 0;
    for (const NodeId node : drawn.node) sum += graph.weight[index(node)];
    constexpr double kHeightPerWeight = 2, kStraightLength = 5;
    return drawn.size() ? kHeightPerWeight * kStraightLength * sum / double(drawn.size()) : 0;
}

std::vector<Source> stage_sources(const Growth& growth, const WeightedLattice& graph, const StageParameters& stage) {
    if (stage.sources == StageParameters::Sources::dendrite)
        return growth.sources(stage.metric == Metric::sum ? stage.carry : 0,
                              mean_cost_per_step(graph, growth.dendrite()));
    std::vector<Source> out;
    const Dendrite& d = growth.dendrite();
    for (std::uint32_t v = 0; v < d.size(); ++v)
        if (d.is_root(v)) out.push_back({d.node[v], 0, d.owner[v]});
    return out;
}

/// How short a side branch may be, in lattice steps: dark areas need short ones for their tone, in
/// light ones they are thorns.
std::function<float(Vec2f)> spur_length(Fields& fields, const StrokeParameters& p) {
    const float dark = p.drop_spurs * fields.u(), light = p.drop_spurs_light * fields.u();
    if (dark == light) return [dark](Vec2f) { return dark; };
    return [tone = blurred(fields["tone"], 4 * fields.u()), dark, light](Vec2f at) {
        return light + (dark - light) * smoothstep(0.1f, 0.6f, sample(tone, at));
    };
}

/// What a unit of length costs on the nodes that a stage added, as a share of its dearest node.
void record_costs(Grid<float>& node_cost, const Dendrite& drawn, std::size_t first, const WeightedLattice& graph,
                  const StageParameters& stage) {
    for (std::size_t v = first; v < drawn.size(); ++v) {
        const std::uint32_t n = index(drawn.node[v]);
        node_cost[n] = float(graph.weight[n]) / float(stage.levels);
    }
}

}  // namespace

Grown grow(Fields& fields, const Grid<std::uint8_t>& passable, const Style& style, const Controls& controls,
           Extent picture_px, const StageObserver& observer, const Work& work) {
    Growth growth(Lattice(fields.extent(), style.lattice.neighbourhood));
    Grown out;
    out.node_cost = Grid<float>(fields.extent());
    for (std::size_t s = 0; s < style.stages.size(); ++s) {
        const StageParameters& stage = style.stages[s];
        work.report(stage.name + ": weights", (0.2 + double(s)) / (double(style.stages.size()) + 1));
        const WeightedLattice graph = weights(fields, passable, style, stage, work);
        if (s == 0) {
            std::uint16_t owner = 0;
            for (const NodeId node : root_nodes(fields, graph, style.root, controls.roots, picture_px))
                growth.add_root(node, owner++);
        }
        std::vector<NodeId> endpoints;
        if (!controls.endpoints.empty())
            endpoints = given_endpoints(controls, stage, s == 0, graph, picture_px);
        else if (stage.endpoints.rule == EndpointParameters::Rule::stipples)
            endpoints = stipples(fields, passable, stage.endpoints, growth.dendrite(), work);
        else
            endpoints = discs(fields, passable, stage.endpoints, growth.dendrite(), controls.seed, std::uint32_t(s));
        work.report(stage.name + ": paths", (0.4 + double(s)) / (double(style.stages.size()) + 1));
        const std::vector<Source> sources = stage_sources(growth, graph, stage);
        const Plan plan =
            bucket_planner().plan({graph, sources, stage.metric, std::uint32_t(stage.blend_factor)}, work);
        if (stage.endpoints.close_loops > 0 && controls.endpoints.empty()) {
            const std::vector<NodeId> closings = loop_closings(fields, graph, plan, stage.endpoints);
            endpoints.insert(endpoints.end(), closings.begin(), closings.end());
        }
        if (observer) observer({stage, graph, plan, endpoints});
        out.endpoints.push_back(endpoints.size());
        const std::size_t before = growth.dendrite().size();
        out.unreached += growth.graft(plan, endpoints, std::uint8_t(s));
        record_costs(out.node_cost, growth.dendrite(), before, graph, stage);
    }
    out.dendrite = without_spurs(growth.dendrite(), spur_length(fields, style.stroke));
    return out;
}

}  // namespace dstylize
