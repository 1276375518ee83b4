#include "stroke/pipe.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/trees.h"

namespace dstylize {
namespace {

TEST(Pipe, WidthsToThePowerAddUpAtForks) {
    const Dendrite d = test::tree({80, 80}, 6, 120).dendrite;
    const Branching b = branching(d);
    PipeParameters p;
    p.gain = 0, p.flare = 0, p.slender = 99, p.widest = 100, p.exponent = 2.5f, p.tip = 1;
    const std::vector<float> widths = pipe_widths(d, b, p, 1);
    std::vector<float> sum(d.size(), 0);
    for (std::uint32_t v = 0; v < d.size(); ++v)
        if (!d.is_root(v)) sum[d.parent[v]] += std::pow(widths[v], p.exponent);
    for (std::uint32_t v = 0; v < d.size(); ++v) {
        const float carried = std::pow(widths[v], p.exponent);
        ASSERT_NEAR(sum[v] == 0 ? 1 : sum[v], carried, 1e-3f * carried);
    }
}

TEST(Pipe, NoBranchIsWiderThanWhatCarriesIt) {
    const Dendrite d = test::tree({80, 80}, 2, 200).dendrite;
    const std::vector<float> widths = pipe_widths(d, branching(d), PipeParameters{}, 1);
    for (std::uint32_t v = 0; v < d.size(); ++v)
        if (!d.is_root(v)) {
            ASSERT_LE(widths[v], widths[d.parent[v]] + 1e-4f);
        }
}

TEST(InkCoverage, IsWhatTheLinesCover) {
    Dendrite d;
    std::uint32_t parent = Dendrite::kRoot;
    for (int i = 0; i < 60; ++i) parent = d.add(NodeId{0}, {float(i) + 0.5f, 20}, parent, 0, 0);
    const Grid<float> ink = ink_coverage(d, std::vector<float>(60, 3), {60, 40}, 4);
    double all = 0;
    for (const float v : ink) all += double(-std::log(1 - v));
    EXPECT_NEAR(all, 59 * 3, 2) << "before saturation, length x width";
    EXPECT_GT(ink(30, 20), 0.2f);
    EXPECT_LT(ink(30, 39), 0.01f);
}

}  // namespace
}  // namespace dstylize
