#include "stipple/poisson_discs.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dstylize {
namespace {

struct Field {
    Grid<float> priority{Extent{120, 90}}, density{Extent{120, 90}};
    Field() {
        const Noise noise(5, Purpose::jitter);
        for (std::size_t n = 0; n < priority.size(); ++n) {
            priority[n] = noise.unit(n);
            density[n] = float(n % 120) / 120;  // denser to the right
        }
    }
    DiscRequest request() const { return {priority, density, 0.1f, 0.2f, 16, 3, Noise(1, Purpose::endpoints)}; }
};

TEST(PoissonDiscs, NoEndpointLiesInAnEarlierDisc) {
    const Field field;
    Occupancy occupancy(field.priority.extent());
    const DiscRequest request = field.request();
    const auto points = poisson_discs(request, occupancy);
    ASSERT_GT(points.size(), 50u);
    for (std::size_t a = 0; a < points.size(); ++a)
        for (std::size_t b = a + 1; b < points.size(); ++b) {
            const std::uint32_t p = index(points[a]), q = index(points[b]);
            const float d = std::hypot(float(p % 120) - float(q % 120), float(p / 120) - float(q / 120));
            ASSERT_GT(d, std::floor(disc_radius(request, field.density[p])));
        }
}

TEST(PoissonDiscs, EveryNodeIsCoveredOrTooUnimportant) {
    const Field field;
    Occupancy occupancy(field.priority.extent());
    poisson_discs(field.request(), occupancy);
    for (std::size_t n = 0; n < occupancy.size(); ++n) ASSERT_TRUE(occupancy[n] || field.priority[n] < 0.1f);
}

TEST(PoissonDiscs, DenseSideGetsMore) {
    const Field field;
    Occupancy occupancy(field.priority.extent());
    std::size_t left = 0, right = 0;
    for (const NodeId node : poisson_discs(field.request(), occupancy)) (index(node) % 120 < 60 ? left : right)++;
    EXPECT_GT(right, 3 * left);
}

TEST(PoissonDiscs, MarkedNodesAreNeverTaken) {
    const Field field;
    Occupancy occupancy(field.priority.extent());
    occupy(occupancy, 60, 45, 20);
    for (const NodeId node : poisson_discs(field.request(), occupancy))
        ASSERT_GT(std::hypot(float(index(node) % 120) - 60, float(index(node) / 120) - 45), 19.0f);
}

}  // namespace
}  // namespace dstylize
