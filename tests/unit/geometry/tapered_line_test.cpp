#include "geometry/tapered_line.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/noise.h"

namespace dstylize {
namespace {

struct Points {
    std::vector<Vec2f> at;
    std::vector<float> width;
    void add(Vec2f p, float w) { at.push_back(p), width.push_back(w); }
};

Points circle(float radius, int count) {
    Points points;
    for (int i = 0; i <= count; ++i) {
        const float angle = 2 * std::numbers::pi_v<float> * float(i) / float(count);
        points.add({radius * std::cos(angle), radius * std::sin(angle)}, 1);
    }
    return points;
}

float distance_to_segment(Vec2f p, Vec2f a, Vec2f b) {
    const Vec2f ab = b - a;
    const float t = std::clamp(dot(p - a, ab) / dot(ab, ab), 0.0f, 1.0f);
    return distance(p, a + ab * t);
}

TEST(SmoothLine, StraightRunsGetNoNewPoints) {
    Points points;
    for (const float x : {0.0f, 1.0f, 1.5f, 4.0f, 9.0f}) points.add({x, 2 * x}, 3);
    EXPECT_EQ(smooth_line(points.at, points.width, 0.01f).size(), points.at.size());
}

TEST(SmoothLine, CoarseCircleBecomesRound) {
    const float radius = 50;
    const Points points = circle(radius, 24);  // facets: 0.43 off the circle
    const TaperedLine line = smooth_line(points.at, points.width, 0.01f);
    for (std::size_t i = 2; i + 3 < line.size(); ++i) {
        const float off = length(lerp(line[i].at, line[i + 1].at, 0.5f)) - radius;
        if (line[i].at.x < 49) {
            EXPECT_NEAR(off, 0, 0.05f) << i;
        }  // not next to the two ends
    }
}

TEST(SmoothLine, PassesThroughEveryPoint) {
    const Points points = circle(7, 9);
    const TaperedLine line = smooth_line(points.at, points.width, 0.01f);
    for (const Vec2f p : points.at)
        EXPECT_TRUE(std::ranges::any_of(line, [&](const WidthPoint& q) { return q.at == p; }));
}

TEST(SmoothLine, SharpTurnsStayCorners) {
    Points points;
    for (const Vec2f p : {Vec2f{0, 0}, Vec2f{10, 0}, Vec2f{20, 0}, Vec2f{20, 10}, Vec2f{20, 20}}) points.add(p, 1);
    for (const WidthPoint& p : smooth_line(points.at, points.width, 0.01f))
        EXPECT_TRUE(p.at.y == 0 || p.at.x == 20) << p.at.x << ' ' << p.at.y;
}

TEST(SmoothLine, WidthsStayBetweenTheirNeighbours) {
    Points points = circle(30, 16);
    const Noise noise(3, Purpose::jitter);
    for (std::size_t i = 0; i < points.width.size(); ++i) points.width[i] = 8 * noise.unit(i);
    const TaperedLine line = smooth_line(points.at, points.width, 0.001f);
    std::size_t knot = 0;
    for (const WidthPoint& p : line) {
        if (knot + 1 < points.at.size() && p.at == points.at[knot + 1]) ++knot;
        const float a = points.width[knot], b = points.width[std::min(knot + 1, points.width.size() - 1)];
        EXPECT_GE(p.width, std::min(a, b) - 1e-4f);
        EXPECT_LE(p.width, std::max(a, b) + 1e-4f);
    }
    EXPECT_GT(line.size(), 4 * points.at.size());
}

TEST(SmoothLine, RepeatedPointsAndNegativeWidthsAreHarmless) {
    Points points;
    for (const Vec2f p : {Vec2f{0, 0}, Vec2f{0, 0}, Vec2f{5, 1}, Vec2f{5, 1}, Vec2f{9, 0}}) points.add(p, -1);
    for (const WidthPoint& p : smooth_line(points.at, points.width, 0.01f)) {
        EXPECT_TRUE(std::isfinite(p.at.x) && std::isfinite(p.at.y));
        EXPECT_EQ(p.width, 0);
    }
}

TEST(Simplified, LeavesNothingFartherThanTheTolerance) {
    const Noise noise(5, Purpose::jitter);
    TaperedLine line;
    for (int i = 0; i < 400; ++i) {
        const float t = float(i) * 0.05f;
        line.push_back({{10 * t, 20 * std::sin(t) + noise.unit(std::uint64_t(i))}, 3 + 2 * std::cos(3 * t)});
    }
    const float tolerance = 0.8f;
    const TaperedLine kept = simplified(line, tolerance);
    EXPECT_LT(kept.size(), line.size() / 3);
    EXPECT_EQ(kept.front(), line.front());
    EXPECT_EQ(kept.back(), line.back());
    std::size_t s = 0;
    for (const WidthPoint& p : line) {
        while (s + 2 < kept.size() && kept[s + 1].at.x < p.at.x) ++s;
        EXPECT_LE(distance_to_segment(p.at, kept[s].at, kept[s + 1].at), tolerance * 1.001f);
    }
}

TEST(Simplified, SwellingOfAStraightStrokeIsKept) {
    const TaperedLine line{{{0, 0}, 1}, {{10, 0}, 5}, {{20, 0}, 1}};
    EXPECT_EQ(simplified(line, 0.1f).size(), 3u);
    EXPECT_EQ(simplified(line, 3.0f).size(), 2u);
}

}  // namespace
}  // namespace dstylize
