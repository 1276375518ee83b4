#include "core/branching.h"

#include <algorithm>

namespace dstylize {

Branching branching(const Dendrite& d) {
    const std::size_t n = d.size();
    Branching out;
    out.main_child.assign(n, Branching::kNone);
    out.tips.assign(n, 0);
    std::vector<float> subtree(n, 0);
    for (std::size_t i = n; i-- > 0;) {
        const auto v = std::uint32_t(i);
        if (out.tips[v] == 0) out.tips[v] = 1;
        if (d.is_root(v)) continue;
        const std::uint32_t p = d.parent[v];
        const float edge = distance(d.position_lattice[v], d.position_lattice[p]);
        subtree[p] += subtree[v] + edge;
        out.tips[p] += out.tips[v];
        std::uint32_t& main = out.main_child[p];
        if (main == Branching::kNone || subtree[v] >= subtree[main]) main = v;
    }
    std::vector<std::uint32_t> branch_of(n, Branch::kNone);
    for (std::uint32_t v = 0; v < n; ++v) {
        const bool root = d.is_root(v);
        if (root ? out.main_child[v] == Branching::kNone
                 : out.main_child[d.parent[v]] == v && branch_of[v] != Branch::kNone)
            continue;
        Branch branch;
        if (!root) {
            branch.nodes.push_back(d.parent[v]);
            branch.parent_branch = branch_of[d.parent[v]];
            branch.order = std::uint16_t(std::min(65535, out.branches[branch.parent_branch].order + 1));
        }
        const auto id = std::uint32_t(out.branches.size());
        for (std::uint32_t k = v; k != Branching::kNone; k = out.main_child[k]) {
            branch.nodes.push_back(k);
            branch_of[k] = id;
        }
        out.branches.push_back(std::move(branch));
    }
    return out;
}

}  // namespace dstylize
