// Boost's Dijkstra on a grid that it sees as a graph: edges are a node and a step, made as they are asked for.
#include <cstdint>
#include <utility>

#include "peers.h"

#ifdef DSTYLIZE_WITH_BOOST
#include <boost/graph/dijkstra_shortest_paths_no_color_map.hpp>
#include <boost/iterator/counting_iterator.hpp>
#include <boost/iterator/iterator_facade.hpp>
#include <boost/property_map/function_property_map.hpp>

// Boost finds the functions of a graph by the namespace of its type, and its types by `graph_traits`.
namespace dstylize_grid {

using Node = std::uint32_t;

struct Edge {
    Node from = 0;
    std::uint32_t step = 0;
};

class Grid8 {
  public:
    static constexpr std::uint32_t kSteps = 8;
    explicit Grid8(const dstylize::WeightedLattice& g)
        : weight_(g.weight.data()), width_(g.lattice.extent().x), height_(g.lattice.extent().y) {
        for (std::uint32_t s = 0; s < kSteps; ++s) step_[s] = g.lattice.steps()[s];
    }
    Node size() const { return Node(width_) * Node(height_); }
    Node target(Edge e) const { return e.from + Node(step_[e.step].dy * width_ + step_[e.step].dx); }
    std::uint32_t cost(Edge e) const {
        return (std::uint32_t(weight_[e.from]) + weight_[target(e)]) * step_[e.step].length5;
    }
    /// The first of its edges from this one on.
    std::uint32_t next_step(Edge e) const {
        const int i = int(e.from) % width_, j = int(e.from) / width_;
        while (e.step < kSteps && !exists(i + step_[e.step].dx, j + step_[e.step].dy)) ++e.step;
        return e.step;
    }

  private:
    bool exists(int i, int j) const {
        return i >= 0 && j >= 0 && i < width_ && j < height_ && weight_[j * std::ptrdiff_t(width_) + i] != 0;
    }
    const dstylize::NodeWeight* weight_;
    int width_, height_;
    dstylize::Step step_[kSteps];
};

class EdgeIterator : public boost::iterator_facade<EdgeIterator, Edge, boost::forward_traversal_tag, Edge> {
  public:
    EdgeIterator() = default;
    EdgeIterator(const Grid8& grid, Edge edge) : grid_(&grid), edge_(edge) { edge_.step = grid.next_step(edge); }

  private:
    friend class boost::iterator_core_access;
    Edge dereference() const { return edge_; }
    bool equal(const EdgeIterator& o) const { return edge_.step == o.edge_.step; }
    void increment() {
        ++edge_.step;
        edge_.step = grid_->next_step(edge_);
    }
    const Grid8* grid_ = nullptr;
    Edge edge_{0, Grid8::kSteps};
};

using NodeIterator = boost::counting_iterator<Node>;

inline std::pair<EdgeIterator, EdgeIterator> out_edges(Node u, const Grid8& g) {
    return {{g, {u, 0}}, {g, {u, Grid8::kSteps}}};
}
inline Node source(Edge e, const Grid8&) { return e.from; }
inline Node target(Edge e, const Grid8& g) { return g.target(e); }
inline std::pair<NodeIterator, NodeIterator> vertices(const Grid8& g) {
    return {NodeIterator(0), NodeIterator(g.size())};
}
inline Node num_vertices(const Grid8& g) { return g.size(); }

}  // namespace dstylize_grid

// NOLINTBEGIN(readability-identifier-naming): the names are Boost's.
template <>
struct boost::graph_traits<dstylize_grid::Grid8> {
    using vertex_descriptor = dstylize_grid::Node;
    using edge_descriptor = dstylize_grid::Edge;
    using directed_category = boost::directed_tag;
    using edge_parallel_category = boost::disallow_parallel_edge_tag;
    struct traversal_category : boost::incidence_graph_tag, boost::vertex_list_graph_tag {};
    using vertices_size_type = std::uint32_t;
    using edges_size_type = std::uint32_t;
    using degree_size_type = std::uint32_t;
    using out_edge_iterator = dstylize_grid::EdgeIterator;
    using vertex_iterator = dstylize_grid::NodeIterator;
    static vertex_descriptor null_vertex() { return ~0u; }
};
// NOLINTEND(readability-identifier-naming)

namespace dstylize {

LabelColumn boost_labels(const WeightedLattice& graph, NodeId source) {
    const dstylize_grid::Grid8 grid(graph);
    UnsetVector<std::uint32_t> sum(grid.size());
    std::vector<std::uint32_t> before(grid.size());
    const auto cost = boost::make_function_property_map<dstylize_grid::Edge, std::uint32_t>(
        [&grid](dstylize_grid::Edge e) { return grid.cost(e); });
    boost::dijkstra_shortest_paths_no_color_map(
        grid, index(source), before.data(), sum.data(), cost, boost::typed_identity_property_map<std::uint32_t>(),
        std::less<>(), boost::closed_plus<std::uint32_t>(), LabelColumn::kUnreached32, 0u, boost::dijkstra_visitor<>());
    return {std::move(sum), {}};
}

bool boost_is_here() { return true; }

}  // namespace dstylize

#else

namespace dstylize {

LabelColumn boost_labels(const WeightedLattice&, NodeId) { return {}; }

bool boost_is_here() { return false; }

}  // namespace dstylize

#endif
