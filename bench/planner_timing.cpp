#include "planner_timing.h"

namespace dstylize {
namespace {

Work by(int threads) {
    Work work;
    work.threads = threads;
    return work;
}

}  // namespace

Plan planned(const Planner& planner, const PlanRequest& request, int threads, int times, double& nanoseconds) {
    const Work work = by(threads);
    return timed(request.graph.weight.size(), times, nanoseconds, [&] { return planner.plan(request, work); });
}

Grid<float> stippling_expense(const WeightedLattice& portrait) {
    Grid<float> expense(portrait.lattice.extent());
    for (std::size_t n = 0; n < expense.size(); ++n) expense[n] = float(portrait.weight[n]) / 255;
    return expense;
}

std::vector<NodeId> stippled(const GraphDistanceRequest& request, int threads, int times, double& nanoseconds) {
    const Work work = by(threads);
    return timed(request.expense.size(), times, nanoseconds, [&] { return graph_distance_stipples(request, work); });
}

}  // namespace dstylize
