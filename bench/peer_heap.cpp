// Binary-heap Dijkstra, Prim and stippling.
#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <queue>
#include <tuple>

#include "peers.h"

namespace dstylize {
namespace {

// Where edges come from. `nodes()` counts nodes with the rim, `place` and `number` translate between a
// node's number in the lattice and in here; a call with a node and a visitor visits (to, height, length5).

/// Weights with a rim of walls.
class RimmedWeights {
  public:
    explicit RimmedWeights(const WeightedLattice& g)
        : width_(std::uint32_t(g.lattice.extent().x)),
          stride_(width_ + 2),
          weight_(std::size_t(stride_) * (std::size_t(g.lattice.extent().y) + 2)) {
        for (int j = 0; j < g.lattice.extent().y; ++j)
            std::copy_n(g.weight.begin() + std::ptrdiff_t(j) * width_, width_,
                        weight_.begin() + std::ptrdiff_t(j + 1) * stride_ + 1);
        const auto steps = g.lattice.steps();
        for (std::size_t s = 0; s < kSteps; ++s) {
            offset_[s] = std::uint32_t(steps[s].dy * int(stride_) + steps[s].dx);
            length5_[s] = steps[s].length5;
        }
    }
    std::size_t nodes() const { return weight_.size(); }
    std::uint32_t place(std::uint32_t n) const { return (n / width_ + 1) * stride_ + n % width_ + 1; }
    std::uint32_t number(std::uint32_t p) const { return (p / stride_ - 1) * width_ + p % stride_ - 1; }
    template <class Visit>
    void operator()(std::uint32_t u, Visit visit) const {
        for (std::size_t s = 0; s < kSteps; ++s) {
            const std::uint32_t v = u + offset_[s];
            if (weight_[v] != kImpassable) visit(v, std::uint32_t(weight_[u]) + weight_[v], length5_[s]);
        }
    }

  private:
    static constexpr std::size_t kSteps = 8;
    std::uint32_t width_, stride_;
    std::vector<NodeWeight> weight_;
    std::array<std::uint32_t, kSteps> offset_{}, length5_{};
};

/// The heights of all edges that leave a node, side by side: one or two of them to a cache line.
template <std::size_t kSteps>
class GatheredPlanes {
  public:
    explicit GatheredPlanes(const WeightedLattice& g) : height_(g.lattice.node_count()) {
        const auto steps = g.lattice.steps();
        const Extent e = g.lattice.extent();
        for (std::size_t s = 0; s < kSteps; ++s) {
            offset_[s] = std::uint32_t(steps[s].dy * e.x + steps[s].dx);
            length5_[s] = steps[s].length5;
        }
        for (int j = 0; j < e.y; ++j)
            for (std::size_t s = 0; s < kSteps; ++s) gather(g, steps[s], s, j);
    }
    std::size_t nodes() const { return height_.size(); }
    static std::uint32_t place(std::uint32_t n) { return n; }
    static std::uint32_t number(std::uint32_t p) { return p; }
    template <class Visit>
    void operator()(std::uint32_t u, Visit visit) const {
        for (std::size_t s = 0; s < kSteps; ++s)
            if (height_[u][s] != 0) visit(u + offset_[s], std::uint32_t(height_[u][s]), length5_[s]);
    }

  private:
    void gather(const WeightedLattice& g, Step step, std::size_t s, int row) {
        const Extent e = g.lattice.extent();
        if (!e.contains(0, row + step.dy)) return;
        const std::vector<std::uint16_t>& plane = g.height_plane[g.symmetric ? s / 2 : s];
        const std::uint32_t away = g.symmetric && s % 2 == 1 ? offset_[s] : 0;
        const std::uint32_t begin = std::uint32_t(row) * std::uint32_t(e.x);
        for (int i = std::max(0, -step.dx); i < std::min(e.x, e.x - step.dx); ++i)
            height_[begin + std::uint32_t(i)][s] = plane[begin + std::uint32_t(i) + away];
    }
    std::vector<std::array<std::uint16_t, kSteps>> height_;
    std::array<std::uint32_t, kSteps> offset_{}, length5_{};
};

/// An irregular lattice by node weights, as it is.
class Listed {
  public:
    explicit Listed(const WeightedLattice& g) : adjacency_(*g.lattice.adjacency()), weight_(g.weight) {}
    std::size_t nodes() const { return weight_.size(); }
    static std::uint32_t place(std::uint32_t n) { return n; }
    static std::uint32_t number(std::uint32_t p) { return p; }
    template <class Visit>
    void operator()(std::uint32_t u, Visit visit) const {
        for (std::uint32_t e = adjacency_.first[u]; e < adjacency_.first[u + 1]; ++e) {
            const std::uint32_t v = adjacency_.to[e];
            if (weight_[v] != kImpassable)
                visit(v, std::uint32_t(weight_[u]) + weight_[v], std::uint32_t(adjacency_.length5[e]));
        }
    }

  private:
    const Adjacency& adjacency_;
    const std::vector<NodeWeight>& weight_;
};

// How labels grow and compare: label(before, height, cost), ordered by <.

struct SumRule {
    using Label = std::uint32_t;
    static constexpr Label kFar = ~Label{0};
    static Label started(std::uint64_t start) { return Label(start); }
    static Label extended(Label before, std::uint32_t, std::uint32_t cost) { return before + cost; }
    static std::uint32_t sum(Label l) { return l; }
};

struct MaxSumRule {
    using Label = std::uint64_t;  // highest edge, then sum
    static constexpr Label kFar = ~Label{0};
    static Label started(std::uint64_t start) { return start; }
    static Label extended(Label before, std::uint32_t height, std::uint32_t cost) {
        return std::max(before >> 32, std::uint64_t(height)) << 32 | (std::uint32_t(before) + cost);
    }
    static std::uint32_t sum(Label l) { return std::uint32_t(l); }
    static std::uint32_t highest(Label l) { return std::uint32_t(l >> 32); }
};

struct BlendRule {
    struct Label {
        std::uint64_t rank = 0;
        std::uint32_t highest = 0, sum = 0;
        friend auto operator<=>(const Label&, const Label&) = default;
    };
    static constexpr Label kFar{~std::uint64_t{0}, ~0u, ~0u};
    std::uint64_t factor;
    static Label started(std::uint64_t start) { return {start, 0, std::uint32_t(start)}; }
    Label extended(Label before, std::uint32_t height, std::uint32_t cost) const {
        const std::uint32_t highest = std::max(before.highest, height), sum = before.sum + cost;
        return {factor * highest + sum, highest, sum};
    }
    static std::uint32_t sum(Label l) { return l.sum; }
    static std::uint32_t highest(Label l) { return l.highest; }
};

template <class Label>
struct Entry {
    Label label;
    std::uint32_t node;
    friend bool operator>(const Entry& a, const Entry& b) { return a.label > b.label; }
};
template <class T>
using MinHeap = std::priority_queue<T, std::vector<T>, std::greater<>>;

template <class Rule, class Edges>
LabelColumn wide_column_of(const std::vector<typename Rule::Label>& label, const Edges& edges, std::size_t count) {
    std::vector<PathLabel> wide(count);
    for (std::uint32_t n = 0; n < count; ++n) {
        const auto& l = label[edges.place(n)];
        if (!(l == Rule::kFar)) wide[n] = {Rule::highest(l), Rule::sum(l)};
    }
    return wide;
}

/// The labels of a peer in lattice order, as a plan has them.
template <class Rule, class Edges>
LabelColumn column_of(const std::vector<typename Rule::Label>& label, const Edges& edges, std::size_t count) {
    constexpr bool kHasHighest = requires(typename Rule::Label l) { Rule::highest(l); };
    UnsetVector<std::uint32_t> sum(count);
    UnsetVector<std::uint16_t> highest(kHasHighest ? count : 0);
    bool fits = true;
    for (std::uint32_t n = 0; n < count; ++n) {
        const auto& l = label[edges.place(n)];
        sum[n] = Rule::sum(l);
        if constexpr (kHasHighest) {
            highest[n] = std::uint16_t(Rule::highest(l));
            fits = fits && (highest[n] == Rule::highest(l) || l == Rule::kFar);
        }
    }
    if constexpr (kHasHighest)
        if (!fits) return wide_column_of<Rule>(label, edges, count);
    return {std::move(sum), std::move(highest)};
}

template <class Rule, class Edges>
LabelColumn dijkstra(const WeightedLattice& g, std::span<const Source> sources, const Rule& rule) {
    const Edges edges(g);
    using Label = typename Rule::Label;
    std::vector<Label> best(edges.nodes(), Rule::kFar);
    MinHeap<Entry<Label>> heap;
    for (const Source& s : sources) {
        const std::uint32_t u = edges.place(index(s.node));
        best[u] = std::min(best[u], Rule::started(s.start));
        heap.push({best[u], u});
    }
    while (!heap.empty()) {
        const Label label = heap.top().label;
        const std::uint32_t u = heap.top().node;
        heap.pop();
        if (best[u] < label) continue;
        edges(u, [&](std::uint32_t v, std::uint32_t height, std::uint32_t length5) {
            const Label l = rule.extended(label, height, height * length5);
            if (!(l < best[v])) return;
            best[v] = l;
            heap.push({l, v});
        });
    }
    return column_of<Rule>(best, edges, g.lattice.node_count());
}

/// An edge that leaves the tree, in the order (height, smaller node, larger node).
struct Leaving {
    std::uint64_t height_and_smaller;
    std::uint32_t larger;
    std::uint32_t length5_and_way;  ///< the lowest bit: it leads to the larger node
    bool operator>(const Leaving& o) const {
        return std::tie(height_and_smaller, larger) > std::tie(o.height_and_smaller, o.larger);
    }
    std::uint32_t smaller() const { return std::uint32_t(height_and_smaller); }
    bool to_larger() const { return (length5_and_way & 1) != 0; }
    std::uint32_t from() const { return to_larger() ? smaller() : larger; }
    std::uint32_t to() const { return to_larger() ? larger : smaller(); }
    std::uint32_t height() const { return std::uint32_t(height_and_smaller >> 32); }
    std::uint32_t cost() const { return height() * (length5_and_way >> 1); }
};

/// Prim: the first edge that leaves the tree comes next. A rim keeps the order of nodes.
template <class Edges>
LabelColumn prim(const WeightedLattice& g, std::span<const Source> sources) {
    const Edges edges(g);
    using Rule = SumRule;
    std::vector<Rule::Label> label(edges.nodes(), Rule::kFar);
    std::vector<std::uint64_t> least(edges.nodes(), ~std::uint64_t{0});  // height_and_smaller of what leads there
    MinHeap<Leaving> heap;
    const auto settle = [&](std::uint32_t u, Rule::Label l) {
        label[u] = l;
        edges(u, [&](std::uint32_t v, std::uint32_t height, std::uint32_t length5) {
            const std::uint64_t key = std::uint64_t(height) << 32 | std::min(u, v);
            if (label[v] != Rule::kFar || key > least[v]) return;
            least[v] = key;
            heap.push({key, std::max(u, v), length5 << 1 | std::uint32_t(v > u)});
        });
    };
    for (const Source& s : sources) settle(edges.place(index(s.node)), Rule::started(s.start));
    while (!heap.empty()) {
        const Leaving e = heap.top();
        heap.pop();
        if (label[e.to()] == Rule::kFar) settle(e.to(), Rule::extended(label[e.from()], e.height(), e.cost()));
    }
    return column_of<Rule>(label, edges, g.lattice.node_count());
}

template <class Edges>
LabelColumn labels(const WeightedLattice& g, std::span<const Source> sources, Metric metric,
                   std::uint32_t blend_factor) {
    switch (metric) {
        case Metric::sum: return dijkstra<SumRule, Edges>(g, sources, {});
        case Metric::max_sum: return dijkstra<MaxSumRule, Edges>(g, sources, {});
        case Metric::blend: return dijkstra<BlendRule, Edges>(g, sources, {blend_factor});
        case Metric::lexicographic: return prim<Edges>(g, sources);
    }
    return {};
}

}  // namespace

LabelColumn heap_labels(const WeightedLattice& graph, std::span<const Source> sources, Metric metric,
                        std::uint32_t blend_factor) {
    if (graph.lattice.adjacency()) return labels<Listed>(graph, sources, metric, blend_factor);
    if (graph.height_plane.empty()) return labels<RimmedWeights>(graph, sources, metric, blend_factor);
    if (graph.lattice.steps().size() == 8) return labels<GatheredPlanes<8>>(graph, sources, metric, blend_factor);
    return labels<GatheredPlanes<16>>(graph, sources, metric, blend_factor);
}

std::vector<NodeId> heap_stipples(const GraphDistanceRequest& request) {
    constexpr float kLevels = 1023;
    const Extent e = request.expense.extent();
    const std::uint32_t stride = std::uint32_t(e.x) + 2;
    const auto threshold = std::uint32_t(std::lround(request.threshold * 2 * kLevels));
    struct Node {
        std::uint32_t distance = 0, cost = 0;  // walls and nodes that were expanded have distance 0
    };
    std::vector<Node> node(std::size_t(stride) * (std::size_t(e.y) + 2));
    for (std::uint32_t n = 0, p = stride + 1; n < request.expense.size(); p += 2)
        for (int i = 0; i < e.x; ++i, ++n, ++p)
            node[p] = {~0u, std::uint32_t(std::max(1L, std::lround(request.expense[n] * kLevels)))};
    MinHeap<std::uint64_t> heap;  // distance, then node
    for (const NodeId n : request.starts) {
        const std::uint32_t p = stride * (index(n) / std::uint32_t(e.x) + 1) + index(n) % std::uint32_t(e.x) + 1;
        heap.push(p);
        node[p].distance = 1;  // below any that an edge leads to
    }
    std::vector<NodeId> stipples;
    while (!heap.empty()) {
        const auto p = std::uint32_t(heap.top());
        auto distance = std::uint32_t(heap.top() >> 32);
        heap.pop();
        if (node[p].distance == 0) continue;
        if (distance > threshold) {
            stipples.push_back(NodeId{(p / stride - 1) * std::uint32_t(e.x) + p % stride - 1});
            distance = 0;
        }
        node[p].distance = 0;
        for (const std::uint32_t v : {p - stride, p - 1, p + 1, p + stride}) {
            const std::uint32_t reached = distance + node[p].cost + node[v].cost;
            if (reached >= node[v].distance) continue;
            node[v].distance = reached;
            heap.push(std::uint64_t(reached) << 32 | v);
        }
    }
    return stipples;
}

}  // namespace dstylize
