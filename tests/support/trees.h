#pragma once
#include <span>

#include "core/dendrite.h"
#include "core/noise.h"
#include "dendrite/graft.h"
#include "graph/planner.h"

namespace dstylize::test {

/// A dendrite grown over random weights from the middle of the bottom row to `count` random endpoints.
struct Tree {
    WeightedLattice graph;
    std::vector<NodeId> endpoints;
    Dendrite dendrite;
};
inline Tree tree(Extent extent, std::uint64_t seed, std::size_t count) {
    Tree out{{Lattice(extent, Neighbourhood::square8), {}, {}, true}, {}, {}};
    const Noise noise(seed, Purpose::white_noise);
    for (std::size_t n = 0; n < extent.count(); ++n) out.graph.weight.push_back(NodeWeight(1 + noise.bits(n) % 200));
    for (std::size_t k = 0; k < count; ++k)
        out.endpoints.push_back(NodeId{std::uint32_t(noise.bits(1000000 + k) % extent.count())});
    Growth growth(out.graph.lattice);
    growth.add_root(out.graph.lattice.at(extent.x / 2, extent.y - 1), 0);
    const auto sources = growth.sources(0, 0);
    growth.graft(reference_planner().plan({out.graph, sources, Metric::max_sum, 5000}, {}), out.endpoints, 0);
    out.dendrite = growth.dendrite();
    return out;
}

}  // namespace dstylize::test
