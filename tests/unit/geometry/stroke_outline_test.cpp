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
    float least = 1e9f;  // the hull is all discs between the two
    for (int k = 0; k <= 400; ++k) {
        const float t = float(k) / 400;
        least = std::min(least, distance(p, lerp(a.at, b.at, t)) - (ra + (rb - ra) * t));
    }
    return least;
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
void expect_union_of_capsules(const TaperedLine& line, const Noise& noise, int probes) {
    const float tolerance = 0.05f;
    const std::vector<Vec2f> polygon = stroke_outline(line, tolerance);
    bool seen_positive = false, seen_negative = false;
    for (int k = 0; k < probes; ++k) {
        const Vec2f p{60 * noise.unit(std::uint64_t(1000 + 2 * k)) - 5,
                      60 * noise.unit(std::uint64_t(1001 + 2 * k)) - 5};
        const float d = distance_to_chain(p, line);
        if (std::abs(d) < 2 * tolerance) continue;
        const int w = winding(p, polygon);
        EXPECT_EQ(w != 0, d < 0) << p.x << ' ' << p.y << " at distance " << d;
        seen_positive |= w > 0;
        seen_negative |= w < 0;
    }
    EXPECT_FALSE(seen_positive && seen_negative);
}

TEST(StrokeOutline, IsTheUnionOfTheCapsulesHoweverTheLineTurns) {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        SCOPED_TRACE(seed);
        const Noise noise(seed, Purpose::jitter);
        TaperedLine line;
        for (int i = 0; i < 6; ++i) {
            const auto n = std::uint64_t(3 * i);
            line.push_back({{50 * noise.unit(n), 50 * noise.unit(n + 1)}, 12 * noise.unit(n + 2)});
        }
        expect_union_of_capsules(line, noise, 400);
    }
}

TEST(StrokeOutline, HoldsWhereTheStrokeIsWiderThanItsBends) {
    TaperedLine line;
    for (int i = 0; i < 40; ++i) {
        const float angle = float(i) * 0.25f, radius = 2 + float(i) * 0.3f;
        line.push_back({{25 + radius * std::cos(angle), 25 + radius * std::sin(angle)}, 8});
    }
    expect_union_of_capsules(line, Noise(1, Purpose::jitter), 3000);
}

TEST(StrokeOutline, HoldsAtAReversalAndAtAStepOfWidth) {
    expect_union_of_capsules({{{10, 10}, 6}, {{40, 10}, 6}, {{20, 10}, 3}}, Noise(2, Purpose::jitter), 3000);
    expect_union_of_capsules({{{10, 20}, 20}, {{12, 20}, 2}, {{40, 25}, 1}}, Noise(3, Purpose::jitter), 3000);
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
