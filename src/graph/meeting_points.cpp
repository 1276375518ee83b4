#include "graph/meeting_points.h"

#include <algorithm>

namespace dstylize {
namespace {

/// Whether two tree paths share a node within `reach` steps of their ends.
class PathPair {
  public:
    PathPair(const Plan& plan, int reach) : plan_(plan), reach_(reach), seen_(plan.parent.size(), 0) {}

    bool merge(NodeId a, NodeId b) {
        ++round_;
        for (int k = 0; k < reach_ && a != kNoNode; ++k, a = plan_.parent[index(a)]) seen_[index(a)] = round_;
        for (int k = 0; k < reach_ && b != kNoNode; ++k, b = plan_.parent[index(b)])
            if (seen_[index(b)] == round_) return true;
        return false;
    }

  private:
    const Plan& plan_;
    int reach_;
    std::vector<std::uint32_t> seen_;
    std::uint32_t round_ = 0;
};

}  // namespace

std::vector<NodeId> meeting_points(const Lattice& lattice, const Plan& plan, const Grid<std::uint8_t>& candidate,
                                   int reach, float apart) {
    constexpr int kForward[4][2] = {{1, 0}, {-1, 1}, {0, 1}, {1, 1}};
    std::vector<NodeId> out;
    PathPair paths(plan, reach);
    const Extent e = lattice.extent();
    for (int j = 0; j < e.y; ++j)
        for (int i = 0; i < e.x; ++i) {
            const NodeId here = lattice.at(i, j);
            if (!candidate(i, j) || plan.owner[index(here)] == Plan::kNoOwner) continue;
            for (const auto& [dx, dy] : kForward) {
                if (!e.contains(i + dx, j + dy) || !candidate(i + dx, j + dy)) continue;
                const NodeId there = lattice.at(i + dx, j + dy);
                if (plan.owner[index(there)] != plan.owner[index(here)] || paths.merge(here, there)) continue;
                const Vec2f at = lattice.position_lattice(here);
                if (std::any_of(out.begin(), out.end(),
                                [&](NodeId n) { return distance(lattice.position_lattice(n), at) < apart; }))
                    continue;
                out.push_back(here);
                out.push_back(there);
            }
        }
    return out;
}

}  // namespace dstylize
