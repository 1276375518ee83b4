#include "dendrite/graft.h"

#include <algorithm>
#include <cmath>

namespace dstylize {

Growth::Growth(const Lattice& lattice) : lattice_(lattice), index_of_(lattice.node_count(), kAbsent) {}

void Growth::add_root(NodeId node, std::uint16_t owner) {
    if (contains(node)) return;
    index_of_[index(node)] = dendrite_.add(node, lattice_.position_lattice(node), Dendrite::kRoot, owner, 0);
}

void Growth::start_layer(std::uint8_t last_shared) {
    std::fill(index_of_.begin(), index_of_.end(), kAbsent);
    for (std::uint32_t v = 0; v < dendrite_.size(); ++v)
        if (dendrite_.stage[v] <= last_shared) index_of_[index(dendrite_.node[v])] = v;
}

std::size_t Growth::graft(const Plan& plan, std::span<const NodeId> endpoints, std::uint8_t stage,
                          const Accept& accept) {
    std::size_t unreached = 0;
    std::vector<NodeId> path;
    for (const NodeId endpoint : endpoints) {
        if (plan.label[index(endpoint)].sum == PathLabel::kUnreached) {
            ++unreached;
            continue;
        }
        path.clear();
        NodeId at = endpoint;
        for (; !contains(at); at = plan.parent[index(at)]) path.push_back(at);
        if (path.empty() || (accept && !accept(path))) continue;
        std::uint32_t parent = index_of_[index(at)];
        for (auto node = path.rbegin(); node != path.rend(); ++node) {
            parent = dendrite_.add(*node, lattice_.position_lattice(*node), parent, dendrite_.owner[parent], stage);
            index_of_[index(*node)] = parent;
        }
    }
    return unreached;
}

std::vector<Source> Growth::sources(double carry, double cost_per_step, double bare) const {
    constexpr double kBarePerStep = 2.5;
    std::vector<Source> out;
    out.reserve(dendrite_.size());
    std::vector<double> arc(dendrite_.size(), 0);
    for (std::uint32_t v = 0; v < dendrite_.size(); ++v) {
        if (!dendrite_.is_root(v)) {
            const std::uint32_t p = dendrite_.parent[v];
            arc[v] = arc[p] + double(distance(dendrite_.position_lattice[v], dendrite_.position_lattice[p]));
        }
        const double start = carry * arc[v] + kBarePerStep * std::max(0.0, bare - arc[v]);
        if (index_of_[index(dendrite_.node[v])] != v) continue;
        out.push_back({dendrite_.node[v], std::uint64_t(std::llround(start * cost_per_step)), dendrite_.owner[v]});
    }
    return out;
}

Dendrite without_spurs(const Dendrite& d, const std::function<float(Vec2f)>& least_length) {
    // The way to the farthest tip: at every fork the child with the longest one stays, so that what is
    // kept never becomes shorter by what is dropped from it.
    std::vector<float> reach(d.size(), 0);
    std::vector<std::uint32_t> longest_child(d.size(), Dendrite::kRoot);
    for (std::size_t i = d.size(); i-- > 0;) {
        const auto v = std::uint32_t(i);
        if (d.is_root(v)) continue;
        const std::uint32_t p = d.parent[v];
        reach[v] += distance(d.position_lattice[v], d.position_lattice[p]);
        if (longest_child[p] == Dendrite::kRoot || reach[v] >= reach[longest_child[p]]) longest_child[p] = v;
        reach[p] = std::max(reach[p], reach[v]);
    }
    std::vector<bool> spur(d.size(), false);
    std::vector<std::uint32_t> kept_as(d.size(), Dendrite::kRoot);
    Dendrite out;
    for (std::uint32_t v = 0; v < d.size(); ++v) {
        if (!d.is_root(v)) {
            const std::uint32_t p = d.parent[v];
            spur[v] = spur[p] || (longest_child[p] != v && reach[v] < least_length(d.position_lattice[v]));
        }
        if (spur[v]) continue;
        const std::uint32_t parent = d.is_root(v) ? Dendrite::kRoot : kept_as[d.parent[v]];
        kept_as[v] = out.add(d.node[v], d.position_lattice[v], parent, d.owner[v], d.stage[v]);
    }
    return out;
}

}  // namespace dstylize
