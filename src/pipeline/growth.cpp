// Stage by stage, batch by batch: weights, endpoints, plan, graft. What a batch sees of the ones before it
// is the dendrite and, when the style asks for it, the field `lacking`.
#include "pipeline/growth.h"

#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/branching.h"
#include "core/noise.h"
#include "core/sampling.h"
#include "dendrite/graft.h"
#include "graph/height_planes.h"
#include "graph/meeting_points.h"
#include "graph/tile_planner.h"
#include "imaging/filters.h"
#include "importance/fractal_noise.h"
#include "pipeline/endpoints.h"
#include "pipeline/roots.h"
#include "stroke/pipe.h"

namespace dstylize {
namespace {

/// Nodes from which on fields are let go that may have to be made again, and from which on time is given for memory.
constexpr std::size_t kLarge = std::size_t{1} << 22, kHuge = std::size_t{1} << 26;

/// One round of a stage.
struct Round {
    const StageParameters& stage;
    std::uint32_t number;
    int batch;
    bool is_last;  ///< no weights are made after it
    std::uint32_t substream() const { return 1 + number + 256 * std::uint32_t(batch); }
};

Grid<float> node_cost(Fields& fields, const Round& round) {
    const StageParameters& stage = round.stage;
    Grid<float> cost = Grid<float>::unset(fields.extent());
    each_index(cost.size(), [&](std::size_t n) { cost[n] = stage.cost_constant; });
    for (const auto& [name, weight] : stage.cost) {
        const Grid<float>& field = fields[name];
        each_index(cost.size(), [&, share = weight](std::size_t n) { cost[n] += share * field[n]; });
    }
    return cost;
}

/// Noise comes on top of what the fields leave, so that no place is without it.
void add_noise(Grid<float>& cost, const Fields& fields, const Round& round) {
    const StageParameters& stage = round.stage;
    if (stage.noise_white > 0) {
        const Noise noise(fields.seed(), Purpose::white_noise, round.substream());
        in_bands(cost.size(), [&](std::size_t begin, std::size_t end) {
            std::array<float, 256> piece;
            for (std::size_t n = begin; n < end; n += piece.size()) {
                const std::span units(piece.data(), std::min(piece.size(), end - n));
                noise.units(n, units);
                for (std::size_t k = 0; k < units.size(); ++k) cost[n + k] += stage.noise_white * units[k];
            }
        });
    }
    if (stage.noise_smooth > 0) {
        const Grid<float> noise = fractal_noise(fields, stage.noise_scale, round.substream());
        each_index(cost.size(), [&](std::size_t n) { cost[n] += 2 * stage.noise_smooth * noise[n] * noise[n]; });
    }
}

/// What direction adds to a stage's costs: the same for all of its rounds.
DirectionalCost directional_cost(Fields& fields, const Lattice& lattice, const StageParameters& stage) {
    DirectionalCost out;
    if (stage.along_flow > 0) out.flow = fields.flow();
    out.strength = stage.along_flow;
    const Vec2f pull{stage.wind, stage.down - stage.up};
    if (length(pull) <= 0) return out;
    const bool falls = !lattice.adjacency() && pull.x == 0 && pull.y > 0;
    out.step_factor = falls ? downward_bias(lattice, pull.y) : pull_factors(lattice, pull);
    return out;
}

/// What the last weights were made of: strokes seldom ask for it again, except for the tone.
void release_intermediates(Fields& fields) {
    constexpr std::string_view kNames[] = {"tone",     "luma",        "lightness",   "darkness",
                                           "gradient", "white_noise", "smooth_noise"};
    const std::span names(kNames);
    if (fields.extent().count() > kLarge) fields.release(fields.extent().count() > kHuge ? names : names.subspan(1));
}

/// Node weights of a round (METHOD: cost = (sum of weighted fields)^power, in integer levels).
WeightedLattice weights(Fields& fields, const PreparedPicture& base, const Round& round, const Growth& growth,
                        const DirectionalCost& directional, const Work& work) {
    const StageParameters& stage = round.stage;
    WeightedLattice graph{base.lattice, {}, {}, true};
    Grid<float> cost = node_cost(fields, round);
    if (round.is_last) release_intermediates(fields);
    if (stage.noise_white > 0 || stage.noise_smooth > 0) {
        transform(cost, [](float c) { return std::max(0.0f, c); });
        add_noise(cost, fields, round);
    }
    graph.weight.resize(cost.size());
    const auto top = float(stage.levels - 1);
    const Adjacency* listed = base.lattice.adjacency();
    each_index(cost.size(), [&](std::size_t n) {
        if (!base.passable[n] || (listed && !sample(base.passable, listed->position_lattice[n]))) return;
        float c = std::max(0.0f, listed ? sample(cost, listed->position_lattice[n]) : cost[n]);
        if (stage.cost_power != 1) c = std::pow(c, stage.cost_power);
        graph.weight[n] = NodeWeight(1 + std::lround(top * std::min(1.0f, c / stage.cost_max)));
    });
    if (stage.earlier_paths < 1)
        each_index(cost.size(), [&](std::size_t n) {
            if (!growth.contains(NodeId{std::uint32_t(n)})) return;
            graph.weight[n] = NodeWeight(std::max(1l, std::lround(stage.earlier_paths * float(graph.weight[n]))));
        });
    if (!directional.flow.empty() || !directional.step_factor.empty()) build_height_planes(graph, directional, work);
    return graph;
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
    each_index(ridge.size(),
               [&](std::size_t n) { candidate[n] = ridge[n] >= p.at_least && graph.weight[n] != kImpassable; });
    const float around = p.close_loops * fields.u();
    return meeting_points(graph.lattice, plan, candidate, std::max(1, int(around)), kApart * around);
}

constexpr double kHeightPerWeight = 2, kStraightLength = 5;

/// What a straight step between nodes of cost `carry_cost` costs.
double cost_per_step(const StageParameters& stage) {
    return kHeightPerWeight * kStraightLength * double(stage.levels - 1) * double(stage.carry_cost / stage.cost_max);
}

double mean_cost_per_step(const WeightedLattice& graph, const Dendrite& drawn) {
    double sum = 0;
    for (const NodeId node : drawn.node) sum += graph.weight[index(node)];
    return drawn.size() ? kHeightPerWeight * kStraightLength * sum / double(drawn.size()) : 0;
}

std::vector<Source> stage_sources(const Growth& growth, const WeightedLattice& graph, const StageParameters& stage,
                                  float u) {
    if (stage.sources == StageParameters::Sources::dendrite) {
        const bool remembers = stage.metric == Metric::sum || stage.metric == Metric::blend;
        const double counted =
            stage.carry_cost > 0 ? cost_per_step(stage) : mean_cost_per_step(graph, growth.dendrite());
        return growth.sources(remembers ? double(stage.carry) : 0, counted, remembers ? double(stage.bare * u) : 0);
    }
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

/// Whether anything in the style looks at what is lacking.
bool looks_at_lack(const StageParameters& stage) {
    return stage.path_lack > -1 || stage.endpoints.density == "lacking" || stage.endpoints.priority == "lacking" ||
           std::any_of(stage.cost.begin(), stage.cost.end(), [](const auto& c) { return c.first == "lacking"; });
}

/// Wanted less drawn ink, as the drawing stands.
Grid<float> lack(Fields& fields, const Dendrite& drawn, const WidthParameters& width, int batch) {
    constexpr float kEarlyWindow_u = 3.7f, kWindow_u = 2.4f;
    constexpr int kEarlyBatches = 3;
    const Branching b = branching(drawn);
    const std::vector<float> widths = pipe_widths(drawn, b, width.pipe, fields.u());
    const float window = (batch < kEarlyBatches ? kEarlyWindow_u : kWindow_u) * fields.u();
    Grid<float> out = ink_coverage(drawn, widths, fields.extent(), window);
    const Grid<float>& wanted = fields["wanted"];
    each_index(out.size(), [&](std::size_t n) { out[n] = width.wanted_gain * wanted[n] - out[n]; });
    return out;
}

/// Which new paths are grown: those that lie where ink is lacking and hardly leave the shape.
Growth::Accept path_filter(Fields& fields, const Lattice& lattice, const Round& round, const Grid<float>& lacking) {
    const StageParameters& p = round.stage;
    if (p.path_lack <= -1 && p.path_inside.empty()) return {};
    const Grid<float>* inside = p.path_inside.empty() ? nullptr : &fields[p.path_inside];
    constexpr float kInside = 0.45f, kRealLack = 0.06f, kShorter = 0.72f;
    constexpr std::size_t kOutsideAnyway = 2, kOutsideOneIn = 12;
    const float longest = p.path_longest * std::pow(kShorter, float(round.batch)) * fields.u();
    return [&lattice, &lacking, &p, inside, longest](std::span<const NodeId> path) {
        std::size_t outside = 0;
        double sum = 0;
        for (const NodeId node : path) {
            const Vec2f at = lattice.position_lattice(node);
            if (inside) outside += sample(*inside, at) < kInside;
            if (p.path_lack > -1) sum += double(sample(lacking, at));
        }
        if (outside > kOutsideAnyway + path.size() / kOutsideOneIn) return false;
        if (p.path_lack <= -1) return true;
        const bool is_long = p.path_longest > 0 && float(path.size()) > longest;
        return sum / double(path.size()) > double(is_long ? kRealLack : p.path_lack);
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

/// What the round before planned, and on what.
struct EarlierRound {
    WeightedLattice graph;
    Metric metric;
    Plan plan;
    std::vector<Source> sources;
};

/// Whether the round after this one may have the same weights: neither noise of its own nor a look at what is drawn.
/// Labels that hold turns serve no other plan.
bool may_be_planned_again(const Style& style, std::size_t stage, bool has_another_batch) {
    const StageParameters& now = style.stages[stage];
    if (now.noise_white > 0 || now.noise_smooth > 0 || looks_at_lack(now)) return false;
    if (now.turn_penalty > 0 || now.earlier_paths < 1) return false;
    if (has_another_batch) return true;
    if (stage + 1 == style.stages.size()) return false;
    const StageParameters& next = style.stages[stage + 1];
    return now.cost == next.cost && now.cost_constant == next.cost_constant && now.levels == next.levels;
}

/// The plan of a round. Labels of the round before are used again where paths are searched on the same weights.
Plan planned(const WeightedLattice& graph, std::span<const Source> sources, const StageParameters& stage,
             const std::optional<EarlierRound>& earlier, const Work& work) {
    PlanRequest request{graph, sources, stage.metric, std::uint32_t(stage.blend_factor)};
    constexpr float kTurnUnit = 256;
    request.turn_penalty = std::uint32_t(std::lround(kTurnUnit * stage.turn_penalty));
    if (earlier && request.turn_penalty == 0 && earlier->metric == stage.metric &&
        earlier->graph.weight == graph.weight && earlier->graph.height_plane == graph.height_plane &&
        earlier->graph.symmetric == graph.symmetric) {
        request.earlier = &earlier->plan;
        request.earlier_sources = earlier->sources;
    }
    return tile_planner().plan(request, work);
}

/// Calls both beside one another: the first is often one thread's work. On a huge lattice one after the other.
template <class Place, class FindPaths>
void both(const Place& place, const FindPaths& find_paths, Extent lattice) {
    if (lattice.count() > kHuge) {
        place();
        find_paths();
    } else {
        // Isolated, the one does not wait for parts of the other.
        tbb::parallel_invoke([&] { tbb::this_task_arena::isolate(place); }, find_paths);
    }
}

}  // namespace

Grown grow(PreparedPicture& base, const Style& style, const Controls& controls, Extent picture_px,
           const StageObserver& observer, const Work& work) {
    Fields& fields = base.fields;
    Growth growth(base.lattice);
    Grown out;
    std::optional<EarlierRound> earlier;
    const auto stages = double(style.stages.size());
    if (style.width.path > 0) out.node_cost = Grid<float>(fields.extent());
    for (std::size_t s = 0; s < style.stages.size(); ++s) {
        const StageParameters& stage = style.stages[s];
        out.endpoints.push_back(0);
        if (s > 0 && stage.layer != style.stages[s - 1].layer) growth.start_layer(0);
        const bool given = !controls.endpoints.empty();
        const DirectionalCost directional = directional_cost(fields, base.lattice, stage);
        const int batches = given ? 1 : stage.batches;
        for (int batch = 0; batch < batches; ++batch) {
            const bool is_last = s + 1 == style.stages.size() && batch + 1 == batches;
            const Round round{stage, std::uint32_t(s), batch, is_last};
            const double done = double(s) + double(batch) / batches;
            work.report(stage.name + ": weights", (0.2 + done) / (stages + 1));
            Grid<float> lacking;
            if (looks_at_lack(stage)) {
                lacking = lack(fields, growth.dendrite(), style.width, batch);
                Grid<float> share = lacking;
                transform(share, [](float v) { return std::clamp(2 * v, 0.0f, 1.0f); });
                fields.replace("lacking", std::move(share));
            }
            WeightedLattice graph = weights(fields, base, round, growth, directional, work);
            if (s == 0 && batch == 0) {
                std::uint16_t owner = 0;
                for (const NodeId node : root_nodes(fields, graph, style.root, controls.roots, picture_px))
                    growth.add_root(node, owner++);
            }
            work.report(stage.name + ": paths", (0.4 + done) / (stages + 1));
            std::vector<NodeId> endpoints;
            Plan plan;
            const auto place = [&] {
                const EndpointView view{base.passable,    graph, growth.dendrite(),
                                        std::uint32_t(s), batch, stage.batches};
                endpoints = given ? given_endpoints(controls, stage, s == 0, graph, picture_px)
                                  : placed_endpoints(fields, stage.endpoints, view, controls.seed, work);
            };
            std::vector<Source> sources = stage_sources(growth, graph, stage, fields.u());
            const auto find_paths = [&] { plan = planned(graph, sources, stage, earlier, work); };
            both(place, find_paths, fields.extent());
            if (stage.endpoints.close_loops > 0 && !given) {
                const std::vector<NodeId> closings = loop_closings(fields, graph, plan, stage.endpoints);
                endpoints.insert(endpoints.end(), closings.begin(), closings.end());
            }
            if (observer) observer({stage, graph, plan, endpoints});
            out.endpoints.back() += endpoints.size();
            const std::size_t before = growth.dendrite().size();
            out.unreached += growth.graft(plan, endpoints, std::uint8_t(s),
                                          given ? Growth::Accept{} : path_filter(fields, base.lattice, round, lacking));
            if (!out.node_cost.empty()) record_costs(out.node_cost, growth.dendrite(), before, graph, stage);
            earlier.reset();
            if (fields.extent().count() <= kLarge && may_be_planned_again(style, s, batch + 1 < batches))
                earlier = EarlierRound{std::move(graph), stage.metric, std::move(plan), std::move(sources)};
        }
    }
    out.dendrite = without_spurs(growth.dendrite(), spur_length(fields, style.stroke));
    return out;
}

}  // namespace dstylize
