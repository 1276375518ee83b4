#include "laws/random_graphs.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "graph/height_planes.h"

namespace dstylize::test {
namespace {

Extent random_extent(Dice& dice, int largest) {
    Extent e{dice.between(1, largest), dice.between(1, largest)};
    switch (dice.below(8)) {
        case 0: e.y = 1; break;
        case 1: e.x = 1; break;
        case 2: e.x = std::min(e.x, 3); break;
        default: break;
    }
    return e;
}

/// Corridors of one node on every second row and column, joined by a random depth-first walk.
std::vector<NodeWeight> maze(Dice& dice, Extent e, NodeWeight floor, NodeWeight wall) {
    std::vector<NodeWeight> weight(e.count(), wall);
    const auto at = [&](int i, int j) -> NodeWeight& {
        return weight[std::size_t(j) * std::size_t(e.x) + std::size_t(i)];
    };
    std::vector<Offset> stack{{0, 0}};
    at(0, 0) = floor;
    constexpr Offset kWays[4] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    while (!stack.empty()) {
        const Offset p = stack.back();
        std::vector<Offset> open;
        for (const Offset o : kWays)
            if (e.contains(p.dx + 2 * o.dx, p.dy + 2 * o.dy) && at(p.dx + 2 * o.dx, p.dy + 2 * o.dy) == wall)
                open.push_back(o);
        if (open.empty()) {
            stack.pop_back();
            continue;
        }
        const Offset o = open[dice.below(std::uint32_t(open.size()))];
        at(p.dx + o.dx, p.dy + o.dy) = at(p.dx + 2 * o.dx, p.dy + 2 * o.dy) = floor;
        stack.push_back({p.dx + 2 * o.dx, p.dy + 2 * o.dy});
    }
    return weight;
}

std::vector<NodeWeight> random_weights(Dice& dice, Extent e) {
    const std::uint32_t kind = dice.below(9);
    if (kind == 0) return maze(dice, e, NodeWeight(dice.between(1, 255)), kImpassable);
    if (kind == 1) return maze(dice, e, NodeWeight(dice.between(1, 5)), 255);
    std::vector<NodeWeight> weight(e.count(), NodeWeight(dice.between(1, 255)));  // kind 2: all equal
    constexpr int kLevels[] = {2, 4, 255, 4095, 32767, 65535};
    if (kind >= 3)
        for (NodeWeight& w : weight) w = NodeWeight(dice.between(1, kLevels[kind - 3]));
    if (dice.one_in(3)) {
        const std::uint32_t percent = dice.below(60);
        for (NodeWeight& w : weight)
            if (dice.below(100) < percent) w = kImpassable;
    }
    return weight;
}

/// Heights of any value where an edge may exist, whatever the weights.
void set_plain_random_planes(Dice& dice, WeightedLattice& g) {
    const int step_count = int(g.lattice.steps().size());
    const std::uint32_t levels = dice.one_in(2) ? 4 : 65535, percent_missing = dice.one_in(2) ? 0 : dice.below(50);
    g.symmetric = dice.one_in(2);
    for (int s = 0; s < step_count; s += g.symmetric ? 2 : 1) {
        std::vector<std::uint16_t>& plane = g.height_plane.emplace_back(g.weight.size(), std::uint16_t{0});
        for (std::uint32_t n = 0; n < plane.size(); ++n) {
            const NodeId to = g.neighbour(NodeId{n}, s);
            if (to == kNoNode || !g.passable(NodeId{n}) || !g.passable(to) || dice.below(100) < percent_missing)
                continue;
            plane[n] = std::uint16_t(1 + dice.below(levels));
        }
    }
}

void set_built_planes(Dice& dice, WeightedLattice& g) {
    DirectionalCost cost;
    cost.strength = float(dice.below(4));
    cost.flow = Grid<Vec2f>(g.lattice.extent());
    for (Vec2f& f : cost.flow) f = {dice.unit() * 2 - 1, dice.unit() * 2 - 1};
    if (dice.one_in(2)) cost.step_factor = downward_bias(g.lattice, 2 * dice.unit());
    build_height_planes(g, cost, {});
}

std::vector<Source> random_sources(Dice& dice, const WeightedLattice& g) {
    std::vector<NodeId> passable;
    for (std::uint32_t n = 0; n < g.weight.size(); ++n)
        if (g.passable(NodeId{n})) passable.push_back(NodeId{n});
    const std::uint32_t count = dice.one_in(3) ? 1 + dice.below(20) : 1 + dice.below(3);
    const std::uint32_t span = dice.one_in(2) ? 1 : dice.one_in(2) ? 50 : 3000000;
    std::vector<Source> sources;
    for (std::uint32_t k = 0; k < count; ++k)
        sources.push_back(
            {passable[dice.below(std::uint32_t(passable.size()))], dice.below(span), std::uint16_t(dice.below(4))});
    return sources;
}

}  // namespace

RandomGraph random_graph(std::uint32_t seed, int largest_side) {
    Dice dice(seed);
    RandomGraph r;
    constexpr Neighbourhood kAll[] = {Neighbourhood::square4, Neighbourhood::square8, Neighbourhood::square16};
    r.graph.lattice = Lattice(random_extent(dice, largest_side), kAll[dice.below(3)]);
    r.graph.weight = random_weights(dice, r.graph.lattice.extent());
    if (std::all_of(r.graph.weight.begin(), r.graph.weight.end(), [](NodeWeight w) { return w == kImpassable; }))
        r.graph.weight[0] = 1;
    const std::uint32_t planes = dice.below(4);
    if (planes == 0) set_plain_random_planes(dice, r.graph);
    if (planes == 1) set_built_planes(dice, r.graph);
    r.sources = random_sources(dice, r.graph);
    r.shape = "seed " + std::to_string(seed) + ": " + std::to_string(r.graph.lattice.extent().x) + " x " +
              std::to_string(r.graph.lattice.extent().y) + ", " + std::to_string(r.graph.lattice.steps().size()) +
              " steps, " + std::to_string(r.graph.height_plane.size()) + " planes, " +
              std::to_string(r.sources.size()) + " sources";
    return r;
}

RandomGraph random_graph_on(Lattice lattice, std::uint32_t seed) {
    Dice dice(seed);
    RandomGraph r;
    const auto nodes = std::uint32_t(lattice.node_count());
    r.graph.lattice = std::move(lattice);
    const int levels = dice.one_in(2) ? 3 : 4000;
    for (std::uint32_t n = 0; n < nodes; ++n)
        r.graph.weight.push_back(dice.one_in(6) ? kImpassable : NodeWeight(dice.between(1, levels)));
    r.graph.weight[0] = 1;
    if (dice.one_in(2)) {
        DirectionalCost cost;
        const Vec2f pull{dice.unit() - 0.5f, -dice.unit()};
        cost.step_factor = pull_factors(r.graph.lattice, pull);
        if (dice.one_in(2)) {
            cost.strength = 2 * dice.unit();
            cost.flow = Grid<Vec2f>(r.graph.lattice.extent());
            for (Vec2f& f : cost.flow) f = {dice.unit() - 0.5f, dice.unit() - 0.5f};
        }
        build_height_planes(r.graph, cost, {});
    }
    r.sources.push_back({NodeId{0}, dice.below(50), 0});
    for (std::uint32_t n = 1; n < nodes; ++n)
        if (dice.one_in(40) && r.graph.passable(NodeId{n})) r.sources.push_back({NodeId{n}, dice.below(50), 1});
    return r;
}

void expect_same_plan(const Plan& found, const Plan& expected, const std::string& what) {
    ASSERT_TRUE(found.label == expected.label) << what;
    ASSERT_TRUE(found.parent == expected.parent) << what;
    ASSERT_TRUE(found.owner == expected.owner) << what;
}

std::vector<bool> reachable(const RandomGraph& g) {
    std::vector<bool> seen(g.graph.lattice.node_count(), false);
    std::vector<NodeId> stack;
    const auto visit = [&](NodeId n) {
        if (seen[index(n)]) return;
        seen[index(n)] = true;
        stack.push_back(n);
    };
    for (const Source& s : g.sources) visit(s.node);
    while (!stack.empty()) {
        const NodeId u = stack.back();
        stack.pop_back();
        for (int s = 0; s < int(g.graph.lattice.steps().size()); ++s)
            if (g.graph.height(u, s) != 0) visit(g.graph.neighbour(u, s));
    }
    return seen;
}

}  // namespace dstylize::test
