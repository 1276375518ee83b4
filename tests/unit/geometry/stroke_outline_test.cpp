#include "geometry/stroke_outline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/noise.h"

namespace dstylize {
namespace {

/// Signed distance to the hull of two discs, negative inside.
float distance_to_capsule(Vec2f p, const WidthPoint& a, const WidthPoint& b) {
    const float ra = a.width / 2, rb = b.width / 2, run = distance(a.at, b.at);
    if (run <= std::abs(ra - rb)) return std::min(distance(p, a.at) - ra, distance(p, b.at) - rb);
    // The hull is all discs between the two; the one that is nearest to p lies before p's foot by this slope.
    const Vec2f along = (b.at - a.at) * (1 / run);
    const float s = dot(p - a.at, along), q = std::abs(dot(p - a.at, perpendicular(along))), lean = (ra - rb) / run;
    const float c = std::clamp(s - q * lean / std::sqrt(1 - lean * lean), 0.0f, run);
    return std::hypot(s - c, q) - (ra - c * lean);
}

float distance_to_chain(Vec2f p, const TaperedLine& line) {
    float least = 1e9f;
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
        least = std::min(least, distance_to_capsule(p, line[i], line[i + 1]));
    return least;
}

int winding(Vec2f p, const std::vector<Vec2f>& polygon) {
    int turns = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2f a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        const float side = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
        if (a.y <= p.y && b.y > p.y && side > 0) ++turns;
        if (a.y > p.y && b.y <= p.y && side < 0) --turns;
    }
    return turns;
}

double area(const std::vector<Vec2f>& polygon) {
    double twice = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2f a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        twice += double(a.x) * b.y - double(a.y) * b.x;
    }
    return std::abs(twice) / 2;
}

/// Where the nonzero rule paints must be exactly where a capsule is, and all parts wind one way.
void expect_union_of_capsules(const TaperedLine& line, std::uint64_t seed, int probes) {
    const float tolerance = 0.05f;
    const std::vector<Vec2f> polygon = stroke_outline(line, tolerance);
    const Noise noise(seed, Purpose::jitter);
    Vec2f lo = line[0].at, hi = lo;
    float reach = 0;
    for (const WidthPoint& p : line) {
        lo = {std::min(lo.x, p.at.x), std::min(lo.y, p.at.y)};
        hi = {std::max(hi.x, p.at.x), std::max(hi.y, p.at.y)};
        reach = std::max(reach, 0.6f * p.width);
    }
    bool seen_positive = false, seen_negative = false;
    for (int k = 0; k < probes; ++k) {
        const auto n = std::uint64_t(k) + 500;
        const Vec2f p{lo.x - reach + (hi.x - lo.x + 2 * reach) * noise.unit(2 * n),
                      lo.y - reach + (hi.y - lo.y + 2 * reach) * noise.unit(2 * n + 1)};
        const float d = distance_to_chain(p, line);
        if (std::abs(d) < 2 * tolerance) continue;
        const int w = winding(p, polygon);
        ASSERT_EQ(w != 0, d < 0) << p.x << ' ' << p.y << " at distance " << d;
        seen_positive |= w > 0;
        seen_negative |= w < 0;
    }
    EXPECT_FALSE(seen_positive && seen_negative);
}

TEST(StrokeOutline, IsTheUnionOfTheCapsulesHoweverTheLineTurns) {
    for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
        SCOPED_TRACE(seed);
        const Noise noise(seed, Purpose::jitter);
        // From steps far longer than the width to far shorter, from constant widths to wild ones.
        const float step = 1 + 20 * noise.unit(400), wildness = noise.unit(401);
        TaperedLine line;
        Vec2f at;
        for (std::uint64_t i = 0; i < 3 + seed % 5; ++i) {
            line.push_back({at, 8 * (1 - wildness * noise.unit(3 * i))});
            at = at + Vec2f{step * (2 * noise.unit(3 * i + 1) - 1), step * (2 * noise.unit(3 * i + 2) - 1)};
        }
        expect_union_of_capsules(line, seed, 60);
    }
}

TEST(StrokeOutline, HoldsWhereItOnceBroke) {
    // Discs inside their neighbours, and bends sharper than the width.
    const std::vector<TaperedLine> lines = {{{{0, 0}, 0.84f}, {{0.14f, 0.37f}, 7.81f}, {{0.98f, 1.11f}, 0.43f}},
                                            {{{0, 0}, 7.86f}, {{0.81f, -1}, 2.8f}, {{-1.12f, -2.94f}, 4.31f}},
                                            {{{0, 0}, 5.22f}, {{-1.05f, 0.95f}, 6.26f}, {{-0.15f, 1.67f}, 3.05f}},
                                            {{{0, 0}, 4.96f},
                                             {{-0.91f, -1.12f}, 7.1f},
                                             {{-2.24f, -2.46f}, 7.17f},
                                             {{-2.69f, -1.6f}, 4.64f},
                                             {{-2.6f, -1.99f}, 5.67f}},
                                            {{{0, 0}, 2.34f}, {{-0.14f, 0.26f}, 4.32f}, {{-0.72f, -0.86f}, 6.48f}},
                                            {{{10, 20}, 20}, {{12, 20}, 2}, {{40, 25}, 1}},
                                            {{{10, 10}, 6}, {{40, 10}, 6}, {{20, 10}, 3}}};
    for (const TaperedLine& line : lines) expect_union_of_capsules(line, 1, 20000);
}

TEST(StrokeOutline, BendsMuchSharperThanTheWidthLeaveNoHoles) {
    // Spots that only the detour through the centreline fills.
    const TaperedLine a{{{0, 0}, 4.91f},
                        {{0.01f, 0.18f}, 5.5f},
                        {{-0.27f, 0.02f}, 5.3f},
                        {{-0.27f, -0.44f}, 4.95f},
                        {{-0.46f, -0.27f}, 7.95f}};
    EXPECT_NE(winding({0.347155f, -2.50681f}, stroke_outline(a, 0.05f)), 0);
    const TaperedLine b{{{0, 0}, 7.57f},           {{-1.41f, -0.77f}, 7.58f}, {{-1.53f, -0.25f}, 6.47f},
                        {{-0.85f, -0.82f}, 5.43f}, {{-1.61f, -1.27f}, 5.86f}, {{-0.59f, -2.24f}, 5.65f}};
    EXPECT_NE(winding({-2.37784f, 2.87817f}, stroke_outline(b, 0.05f)), 0);
}

TEST(StrokeOutline, HoldsWhereTheStrokeIsWiderThanItsBends) {
    TaperedLine line;
    for (int i = 0; i < 40; ++i) {
        const float angle = float(i) * 0.25f, radius = 2 + float(i) * 0.3f;
        line.push_back({{25 + radius * std::cos(angle), 25 + radius * std::sin(angle)}, 8});
    }
    expect_union_of_capsules(line, 1, 3000);
}

TEST(StrokeOutline, StraightStrokeHasTheAreaOfACapsule) {
    const double expected = 30 * 4 + std::numbers::pi * 4;
    EXPECT_NEAR(area(stroke_outline(TaperedLine{{{0, 0}, 4}, {{18, 24}, 4}}, 0.001f)), expected, 0.02);
}

TEST(StrokeOutline, OnePointIsADiscAndNoWidthIsNothing) {
    EXPECT_NEAR(area(stroke_outline(TaperedLine{{{5, 5}, 6}}, 0.001f)), std::numbers::pi * 9, 0.05);
    EXPECT_TRUE(stroke_outline({}, 0.01f).empty());
    EXPECT_TRUE(stroke_outline(TaperedLine{{{0, 0}, 0}, {{5, 5}, 0}}, 0.01f).empty());
}

}  // namespace
}  // namespace dstylize
