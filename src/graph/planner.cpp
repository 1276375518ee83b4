#include "graph/planner.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <tuple>

#include "graph/detail_sources.h"

namespace dstylize {

std::span<const std::string_view> metric_names() {
    static constexpr std::array kNames{
#define DSTYLIZE_METRIC(identifier, name) std::string_view(name),
#include "graph/metrics.def"
#undef DSTYLIZE_METRIC
    };
    return kNames;
}

std::vector<Source> distinct_sources(const PlanRequest& request) {
    std::vector<Source> sources(request.sources.begin(), request.sources.end());
    if (sources.empty())
        throw Error(ErrorCode::bad_usage, "", "there is no root to grow from",
                    "name a root on a node that may be grown on");
    for (const Source& s : sources) {
        assert(index(s.node) < request.graph.lattice.node_count() && s.owner != Plan::kNoOwner);
        assert(s.start <= kLargestStart);
        if (!request.graph.passable(s.node))
            throw Error(ErrorCode::bad_usage, "", "a root lies where nothing may grow", "move it or change the mask");
    }
    const auto order = [](const Source& s) { return std::tuple(index(s.node), s.start, s.owner); };
    std::sort(sources.begin(), sources.end(), [&](const Source& a, const Source& b) { return order(a) < order(b); });
    const auto same_node = [](const Source& a, const Source& b) { return a.node == b.node; };
    sources.erase(std::unique(sources.begin(), sources.end(), same_node), sources.end());
    return sources;
}

const Plan* reusable_plan(const PlanRequest& request, const std::vector<Source>& sources) {
    if (request.earlier == nullptr) return nullptr;
    const auto still_holds = [&](const Source& earlier) {
        const auto before = [](const Source& s, NodeId node) { return index(s.node) < index(node); };
        const auto now = std::lower_bound(sources.begin(), sources.end(), earlier.node, before);
        return now != sources.end() && now->node == earlier.node && now->start <= earlier.start;
    };
    const auto& earlier = request.earlier_sources;
    return std::all_of(earlier.begin(), earlier.end(), still_holds) ? request.earlier : nullptr;
}

}  // namespace dstylize
