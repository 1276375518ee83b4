#include "geometry/cubic_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/stroke_outline.h"

namespace dstylize {
namespace {

std::vector<Vec2f> ellipse(float a, float b, int count) {
    std::vector<Vec2f> points;
    for (int i = 0; i < count; ++i) {
        const float t = 2 * std::numbers::pi_v<float> * float(i) / float(count);
        points.push_back({a * std::cos(t), b * std::sin(t)});
    }
    return points;
}

std::vector<Vec2f> flattened(const CubicPath& path) {
    std::vector<Vec2f> points{path.start};
    for (const CubicPiece& piece : path.pieces) {
        const Vec2f from = points.back();
        for (int k = 1; k <= 32; ++k) {
            const float t = float(k) / 32, s = 1 - t;
            points.push_back(piece.straight ? lerp(from, piece.end, t)
                                            : from * (s * s * s) + piece.control1 * (3 * s * s * t) +
                                                  piece.control2 * (3 * s * t * t) + piece.end * (t * t * t));
        }
    }
    return points;
}

float distance_to_polyline(Vec2f p, const std::vector<Vec2f>& line) {
    float least = 1e9f;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const Vec2f a = line[i], ab = line[(i + 1) % line.size()] - a;
        const float squared = dot(ab, ab);
        const float t = squared > 0 ? std::clamp(dot(p - a, ab) / squared, 0.0f, 1.0f) : 0.0f;
        least = std::min(least, distance(p, a + ab * t));
    }
    return least;
}

TEST(FittedPath, StaysWithinTheTolerance) {
    TaperedLine wave;
    for (int i = 0; i < 600; ++i)
        wave.push_back({{float(i) * 0.3f, 30 * std::sin(float(i) * 0.02f)}, 6 - float(i) * 0.009f});
    for (const auto& polygon : {ellipse(40, 15, 200), stroke_outline(wave, 0.01f)}) {
        for (const float tolerance : {0.02f, 0.1f, 0.5f}) {
            const CubicPath path = fitted_path(polygon, tolerance);
            const std::vector<Vec2f> curve = flattened(path);
            for (const Vec2f p : polygon) EXPECT_LE(distance_to_polyline(p, curve), tolerance * 1.05f);
            for (const Vec2f p : curve) EXPECT_LE(distance_to_polyline(p, polygon), tolerance * 1.05f);
        }
    }
}

TEST(FittedPath, LongEdgesBesideArcsDoNotBulge) {
    const auto capsule = stroke_outline(TaperedLine{{{0, 0}, 12}, {{200, 30}, 3}}, 0.01f);
    for (const Vec2f p : flattened(fitted_path(capsule, 0.05f)))
        EXPECT_LE(distance_to_polyline(p, capsule), 0.06f) << p.x << ' ' << p.y;
}

TEST(FittedPath, NeedsFewPiecesAndEndsWhereItStarts) {
    const CubicPath path = fitted_path(ellipse(40, 15, 400), 0.05f);
    EXPECT_LE(path.pieces.size(), 10u);
    EXPECT_EQ(path.pieces.back().end, path.start);
}

TEST(FittedPath, CornersStaySharpAndSidesStraight) {
    const std::vector<Vec2f> square{{0, 0}, {5, 0}, {10, 0}, {10, 10}, {0, 10}};
    const CubicPath path = fitted_path(square, 0.1f);
    ASSERT_EQ(path.pieces.size(), 4u);
    for (const CubicPiece& piece : path.pieces) EXPECT_TRUE(piece.straight);
}

TEST(FittedPath, TooFewPointsGiveNothing) {
    EXPECT_TRUE(fitted_path({}, 0.1f).pieces.empty());
    EXPECT_TRUE(fitted_path(std::vector<Vec2f>{{1, 1}, {1, 1}, {2, 2}}, 0.1f).pieces.empty());
}

}  // namespace
}  // namespace dstylize
