#include "planner_rows.h"

#include <fmt/format.h>

#include <array>
#include <random>

#include "graph/bucket_planner.h"
#include "graph/height_planes.h"
#include "graph/scattered_lattice.h"
#include "graph/tile_planner.h"
#include "peers.h"
#include "planner_timing.h"
#include "weight_maps.h"

namespace dstylize {
namespace {

constexpr int kRuns = 3;

std::string_view name_of(Edges edges) {
    constexpr std::array<std::string_view, 5> kNames{"weights, 8", "planes, 8", "planes, 16", "planes, 16, falling",
                                                     "irregular, 12"};
    return kNames[std::size_t(edges)];
}

std::string_view name_of(Starts starts) {
    constexpr std::array<std::string_view, 6> kNames{"",        ", 100 owners", ", 1000 owners",
                                                     ", grown", ", carried",    ", grown twice"};
    return kNames[std::size_t(starts)];
}

WeightedLattice graph_of(const Row& row, double mega) {
    const bool sixteen = row.edges == Edges::planes16 || row.edges == Edges::falling16;
    WeightedLattice g = weight_map(row.map, mega, sixteen ? Neighbourhood::square16 : Neighbourhood::square8);
    if (row.edges == Edges::weights8) return g;
    if (row.edges == Edges::irregular) {
        const Extent e = g.lattice.extent();
        g.lattice = scattered_lattice(e, Grid<std::uint8_t>(e, 1), Noise(1, Purpose::jitter), {});
        return g;
    }
    DirectionalCost cost;
    cost.strength = 1.5f;
    cost.flow = Grid<Vec2f>(g.lattice.extent(), Vec2f{0.6f, 0.5f});
    if (row.edges == Edges::falling16) cost.step_factor = downward_bias(g.lattice, 1.2f);
    build_height_planes(g, cost, {});
    return g;
}

/// Different passable nodes, spread over all the lattice.
std::vector<NodeId> scattered_nodes(const WeightedLattice& g, std::size_t count) {
    std::mt19937 random(1);
    std::vector<std::uint8_t> taken(g.weight.size());
    std::vector<NodeId> out;
    while (out.size() < count) {
        const NodeId node{std::uint32_t(random() % g.weight.size())};
        if (!g.passable(node) || taken[index(node)]) continue;
        taken[index(node)] = 1;
        out.push_back(node);
    }
    return out;
}

std::vector<Source> owned_apart(const WeightedLattice& g, std::size_t count) {
    std::vector<Source> sources;
    for (const NodeId node : scattered_nodes(g, count)) sources.push_back({node, 0, std::uint16_t(sources.size())});
    return sources;
}

/// Adds the paths that a round draws on a plan to its sources.
void grow(const WeightedLattice& g, const Plan& plan, std::size_t endpoints, bool carried,
          std::vector<Source>& sources) {
    std::vector<std::uint8_t> taken(g.weight.size());
    for (const Source& s : sources) taken[index(s.node)] = 1;
    for (NodeId node : scattered_nodes(g, endpoints))
        for (; node != kNoNode && !taken[index(node)]; node = plan.parent[index(node)]) {
            taken[index(node)] = 1;
            sources.push_back({node, carried ? plan.label[index(node)].sum / 2 : 0, 0});
        }
}

/// What a row plans.
class Setting {
  public:
    Setting(const Row& row, double mega)
        : graph(graph_of(row, mega)),
          sources{{map_source(graph.lattice), 0, 0}},
          metric_(row.metric),
          again_(row.again) {
        constexpr std::size_t kEndpoints = 200;
        if (row.starts == Starts::owners100) sources = owned_apart(graph, 100);
        if (row.starts == Starts::owners1000) sources = owned_apart(graph, 1000);
        if (row.starts < Starts::grown) return;
        plan_and_grow(kEndpoints, row.starts == Starts::carried);
        if (row.starts == Starts::grown_twice) plan_and_grow(2 * kEndpoints, false);  // the first half is there
    }
    PlanRequest before() const { return {graph, sources_before_, metric_}; }
    PlanRequest from_nothing() const { return {graph, sources, metric_}; }
    PlanRequest request() const {
        PlanRequest r = from_nothing();
        if (again_) r.earlier = &before_, r.earlier_sources = sources_before_;
        return r;
    }
    const WeightedLattice graph;
    std::vector<Source> sources;

  private:
    void plan_and_grow(std::size_t endpoints, bool carried) {
        sources_before_ = sources;
        before_ = tile_planner().plan(before(), {});
        grow(graph, before_, endpoints, carried, sources);
    }
    Metric metric_;
    bool again_;
    std::vector<Source> sources_before_;
    Plan before_;
};

/// Holds other answers against that of the tiles.
class Judge {
  public:
    Judge(const Row& row, const Plan& plan) : row_(row), plan_(plan) {}
    void labels(const LabelColumn& label, const char* peer) const { demand(label == plan_.label, peer, "labels"); }
    void all(const Plan& plan, const char* peer) const {
        labels(plan.label, peer);
        demand(plan.parent == plan_.parent, peer, "parents");
        demand(plan.owner == plan_.owner, peer, "owners");
    }

  private:
    void demand(bool same, const char* peer, const char* what) const {
        if (!same) throw Disagreement(fmt::format("{} and the planner have other {} on {}", peer, what, name_of(row_)));
    }
    const Row& row_;
    const Plan& plan_;
};

double rows_relaxed(const PlanRequest& request) {
    TileStats stats;
    Work work;
    work.threads = 1;
    plan_by_tiles(request, work, stats);
    return double(stats.rows_relaxed);
}

/// The plan before, and one of the same sources that does not know it, beside the plan that does.
void compare_with_before(Row row, const Setting& s, const Judge& judge, Measured& m) {
    double before = 0, before_by_two = 0, from_nothing = 0, from_nothing_by_two = 0;
    planned(tile_planner(), s.before(), 1, kRuns, before);
    planned(tile_planner(), s.before(), 2, kRuns, before_by_two);
    judge.all(planned(tile_planner(), s.from_nothing(), 1, kRuns, from_nothing), "a plan from nothing");
    planned(tile_planner(), s.from_nothing(), 2, kRuns, from_nothing_by_two);
    row.again = false;
    const auto add = [&, name = name_of(row)](const char* ratio, double value, bool by_two) {
        m.ratios.push_back({name + ": " + ratio, value, 0, false, by_two});
    };
    add("plan before / again", before / m.times.tiles, false);
    add("plan before / again, by two", before_by_two / m.times.tiles_by_two, true);
    add("from nothing / again", from_nothing / m.times.tiles, false);
    add("from nothing / again, by two", from_nothing_by_two / m.times.tiles_by_two, true);
    add("from nothing / again, rows relaxed", rows_relaxed(s.from_nothing()) / rows_relaxed(s.request()), false);
}

/// Planes beside 8 neighbours by the weights that they were made of, measured at once, as the machine's speed drifts.
void compare_with_weights(const Row& row, double mega, Measured& m) {
    constexpr double kBar8 = 2, kBar16 = 3.5;
    const Setting weights({row.map, row.metric, Edges::weights8}, mega);
    double time = 0;
    planned(tile_planner(), weights.request(), 1, kRuns, time);
    const double bar = row.edges == Edges::planes8 ? kBar8 : kBar16;
    m.ratios.push_back({name_of(row) + " / weights, 8", m.times.tiles / time, bar, true});
}

/// Those that stand beside `sum` from one source alone.
void time_guests(const Row& row, const Setting& s, const Judge& judge, Times& t) {
    const std::size_t nodes = s.graph.weight.size();
    const NodeId source = s.sources.front().node;
    if (boost_is_here()) judge.labels(timed(nodes, 1, t.boost, [&] { return boost_labels(s.graph, source); }), "Boost");
    // They know no walls, and 255 levels.
    if (row.map == "portrait" || row.map == "noise" || row.map == "constant")
        timed(nodes, 1, t.scissors, [&] { return scissors_map(s.graph, source), 0; });
}

}  // namespace

std::string name_of(const Row& row) {
    return fmt::format("{}, {}, {}{}{}", row.map, metric_names()[std::size_t(row.metric)], name_of(row.edges),
                       name_of(row.starts), row.again ? ", again" : "");
}

Measured measured(const Row& row, double mega) {
    const Setting s(row, mega);
    Measured m;
    Times& t = m.times;
    const bool by_tiles = row.metric != Metric::blend;
    const int times = by_tiles ? kRuns : 1;  // the rest goes to the buckets, and takes long
    const Plan plan = planned(tile_planner(), s.request(), 1, times, t.tiles);
    const Judge judge(row, plan);
    judge.all(planned(tile_planner(), s.request(), 2, times, t.tiles_by_two), "two threads");
    if (by_tiles) judge.all(planned(bucket_planner(), s.from_nothing(), 1, 1, t.bucket), "buckets");
    const auto heap = [&] { return heap_labels(s.graph, s.sources, row.metric); };
    judge.labels(timed(s.graph.weight.size(), 1, t.heap, heap), "the heap");
    if (row.again) compare_with_before(row, s, judge, m);
    if (row.metric != Metric::sum) return m;
    if (row.edges == Edges::planes8 || row.edges == Edges::planes16) compare_with_weights(row, mega, m);
    if (row.edges == Edges::weights8 && row.starts == Starts::one) time_guests(row, s, judge, t);
    return m;
}

Times measured_stippling(double mega, std::size_t& count) {
    const WeightedLattice g = weight_map("portrait", mega, Neighbourhood::square4);
    const Grid<float> expense = stippling_expense(g);
    const NodeId start[] = {map_source(g.lattice)};
    const GraphDistanceRequest request{expense, kStipplingThreshold, start, {}};
    Times t;
    const auto ours = stippled(request, 1, kRuns, t.tiles), by_two = stippled(request, 2, kRuns, t.tiles_by_two);
    const auto theirs = timed(expense.size(), 1, t.heap, [&] { return heap_stipples(request); });
    if (ours != theirs || ours != by_two) throw Disagreement("the heap or two threads place other stipples");
    count = ours.size();
    return t;
}

}  // namespace dstylize
