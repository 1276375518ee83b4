#include "stipple/poisson_discs.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace dstylize {
namespace {

/// Candidate nodes, highest priority first, ties by node index: a counting sort on 16 bits.
std::vector<std::uint32_t> by_priority(const DiscRequest& request, const Occupancy& occupancy) {
    constexpr int kLevels = 1 << 16;
    std::vector<std::uint32_t> start(kLevels + 1, 0);
    std::vector<std::uint16_t> level(request.priority.size());
    std::vector<bool> taken(request.priority.size(), false);
    for (std::uint32_t n = 0; n < level.size(); ++n) {
        const float priority = request.priority[n];
        if (priority < request.priority_at_least || occupancy[n]) continue;
        const float rank = (priority + request.jitter * request.noise.unit(n)) / (1 + request.jitter);
        level[n] = std::uint16_t(kLevels - 1 - std::min(kLevels - 1, int(rank * kLevels)));
        taken[n] = true;
        ++start[level[n] + 1u];
    }
    for (std::size_t k = 1; k < start.size(); ++k) start[k] += start[k - 1];
    std::vector<std::uint32_t> order(start.back());
    for (std::uint32_t n = 0; n < level.size(); ++n)
        if (taken[n]) order[start[level[n]]++] = n;
    return order;
}

}  // namespace

void occupy(Occupancy& occupancy, int column, int row, float radius) {
    const Extent e = occupancy.extent();
    const int reach = int(radius);
    for (int j = std::max(0, row - reach); j <= std::min(e.y - 1, row + reach); ++j) {
        const float dy = float(j - row);
        const int half = int(std::sqrt(std::max(0.0f, radius * radius - dy * dy)));
        const int first = std::max(0, column - half), last = std::min(e.x - 1, column + half);
        if (first <= last) std::memset(occupancy.row(j) + first, 1, std::size_t(last - first + 1));
    }
}

float disc_radius(const DiscRequest& request, float density) {
    return request.calm_spacing * std::pow(request.dense_spacing / request.calm_spacing, density);
}

std::vector<NodeId> poisson_discs(const DiscRequest& request, Occupancy& occupancy) {
    std::vector<NodeId> endpoints;
    for (const std::uint32_t n : by_priority(request, occupancy)) {
        if (occupancy[n]) continue;
        const auto width = std::uint32_t(occupancy.extent().x);
        occupy(occupancy, int(n % width), int(n / width), disc_radius(request, request.density[n]));
        endpoints.push_back(NodeId{n});
    }
    return endpoints;
}

}  // namespace dstylize
