// Every planner gives the reference's answer, bit for bit: labels, parents, owners.
#include <gtest/gtest.h>

#include "graph/bucket_planner.h"
#include "graph/planner.h"
#include "laws/random_graphs.h"
#include "support/sanitized.h"

namespace dstylize {
namespace {

using test::kMetrics;
using test::random_graph;
using test::RandomGraph;

void expect_reference_answer(const Planner& planner, const RandomGraph& g, std::uint32_t blend_factor = 5000) {
    for (const Metric metric : kMetrics) {
        const PlanRequest request{g.graph, g.sources, metric, blend_factor};
        const Plan expected = reference_planner().plan(request, {}), found = planner.plan(request, {});
        const std::string what = g.shape + ", " + std::string(metric_names()[std::size_t(metric)]);
        ASSERT_NO_FATAL_FAILURE(test::expect_same_plan(found, expected, what));
    }
}

TEST(BucketPlanner, AgreesWithTheReferenceOnTenThousandGraphs) {
    for (std::uint32_t seed = 0; seed < 10000; ++seed)
        ASSERT_NO_FATAL_FAILURE(expect_reference_answer(bucket_planner(), random_graph(seed, 16)));
}

TEST(BucketPlanner, AgreesWithTheReferenceOnLargerGraphs) {
    for (std::uint32_t seed = 20000; seed < 20000 + test::fewer_if_sanitized(200); ++seed)
        ASSERT_NO_FATAL_FAILURE(expect_reference_answer(bucket_planner(), random_graph(seed, 120)));
}

TEST(BucketPlanner, AgreesWithTheReferenceForAnyBlend) {
    for (std::uint32_t seed = 30000; seed < 30000 + test::fewer_if_sanitized(400); ++seed)
        for (const std::uint32_t factor : {0u, 1u, 37u, 0xffffffffu})
            ASSERT_NO_FATAL_FAILURE(expect_reference_answer(bucket_planner(), random_graph(seed, 16), factor));
}

TEST(BucketPlanner, AgreesWithTheReferenceWhereSumsNeedMoreBitsThanItsKeysHave) {
    for (std::uint32_t seed = 40000; seed < 40100; ++seed) {
        RandomGraph g = random_graph(seed, 16);
        for (Source& s : g.sources) s.start += kLargestStart - 3000000;
        ASSERT_NO_FATAL_FAILURE(expect_reference_answer(bucket_planner(), g));
    }
}

}  // namespace
}  // namespace dstylize
