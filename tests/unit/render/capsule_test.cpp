#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "render/detail_capsule.h"

namespace dstylize {
namespace {

CoveragePlane plane(int side) {
    CoveragePlane p;
    p.width = p.height = side;
    p.coverage.assign(std::size_t(side) * std::size_t(side), 0.0f);
    p.colour.assign(p.coverage.size(), 0);
    return p;
}

CoveragePlane painted(TaperedLine line, int side) {
    CoveragePlane p = plane(side);
    straighten_thin_ends(line);
    paint_segments(p, line, 0, std::max<std::size_t>(line.size(), 2) - 2, 1);
    return p;
}

double ink(const CoveragePlane& p) {
    double sum = 0;
    for (const float c : p.coverage) sum += c;
    return sum;
}

/// A stroke about the middle of a plane of 100 samples.
TaperedLine centred(float length, float width, float degrees, Vec2f shift = {}) {
    const float angle = degrees * std::numbers::pi_v<float> / 180;
    const Vec2f half = Vec2f{std::cos(angle), std::sin(angle)} * (length / 2), middle = Vec2f{50, 50} + shift;
    return {{middle - half, width}, {middle + half, width}};
}

TEST(Capsule, CoverageIntegratesToItsArea) {
    for (const float width : {0.1f, 0.4f, 0.9f, 1.1f, 1.35f, 1.5f, 2.0f, 6.0f})
        for (const float degrees : {0.0f, 7.0f, 30.0f, 45.0f, 71.0f, 90.0f})
            for (const Vec2f shift : {Vec2f{0, 0}, Vec2f{0.25f, 0.4f}, Vec2f{0.5f, 0.5f}}) {
                const double area = 60 * width + std::numbers::pi * width * width / 4;
                EXPECT_NEAR(ink(painted(centred(60, width, degrees, shift), 100)) / area, 1, 0.01)
                    << width << " wide at " << degrees << " degrees";
            }
}

TEST(Capsule, ShortThinStrokesAreNotLengthened) {
    for (const float length : {0.0f, 0.5f, 2.0f, 4.0f})
        for (const float width : {0.2f, 0.6f, 1.2f}) {
            double sum = 0;  // a single one depends on where it falls in its samples
            for (int k = 0; k < 64; ++k)
                sum += ink(painted(centred(length, width, float(k) * 37, {float(k % 8) / 8, float(k / 8) / 8}), 100));
            const double area = double(length) * width + std::numbers::pi * width * width / 4;
            EXPECT_NEAR(sum / 64 / area, 1, 0.06) << length << " long, " << width << " wide";
        }
}

TEST(Capsule, TaperedStrokeHasTheAreaOfItsWidths) {
    const TaperedLine line{{{20, 30}, 6}, {{80, 70}, 0.2f}};
    const double length = std::hypot(60.0, 40.0);
    // The hull of two discs: the trapezoid and the ends, up to the lean of the sides.
    EXPECT_NEAR(ink(painted(line, 100)), length * 3.1 + std::numbers::pi * 9 / 2, 2.0);
}

TEST(Capsule, StraightEdgesAreExactAreas) {
    // Rows 10.3 to 12.9: row 10 is covered by 0.7, row 12 by 0.9.
    const CoveragePlane p = painted({{{-20, 11.6f}, 2.6f}, {{120, 11.6f}, 2.6f}}, 100);
    for (int x = 0; x < 100; ++x) {
        EXPECT_NEAR(p.coverage[std::size_t(9 * 100 + x)], 0, 1e-3);
        EXPECT_NEAR(p.coverage[std::size_t(10 * 100 + x)], 0.7, 1e-3);
        EXPECT_NEAR(p.coverage[std::size_t(11 * 100 + x)], 1, 1e-3);
        EXPECT_NEAR(p.coverage[std::size_t(12 * 100 + x)], 0.9, 1e-3);
    }
}

TEST(Capsule, AgreesWithCountingSubsamples) {
    const Vec2f a{20.3f, 31.7f}, b{71.2f, 58.4f};
    for (const float width : {0.5f, 1.6f, 5.0f}) {
        const CoveragePlane p = painted({{a, width}, {b, width}}, 100);
        constexpr int kSub = 16;
        for (int y = 25; y < 65; ++y)
            for (int x = 24; x < 68; ++x) {  // clear of the ends, whose thin form is square
                int hits = 0;
                for (int k = 0; k < kSub * kSub; ++k) {
                    const Vec2f q{float(x) + (float(k % kSub) + 0.5f) / kSub,
                                  float(y) + (float(k / kSub) + 0.5f) / kSub};
                    const Vec2f ab = b - a;
                    hits += std::abs(dot(q - a, perpendicular(normalized(ab)))) <= width / 2;
                }
                EXPECT_NEAR(p.coverage[std::size_t(y * 100 + x)], hits / double(kSub * kSub), 0.03)
                    << width << " wide at " << x << ' ' << y;
            }
    }
}

TEST(Capsule, JointsOfAStraightLineCannotBeSeen) {
    for (const float width : {0.3f, 1.0f, 1.6f, 7.0f}) {
        const TaperedLine whole = centred(70, width, 33);
        TaperedLine parts{whole[0]};
        for (const float t : {0.21f, 0.22f, 0.5f, 0.77f}) parts.push_back({lerp(whole[0].at, whole[1].at, t), width});
        parts.push_back(whole[1]);
        const CoveragePlane a = painted(whole, 100), b = painted(parts, 100);
        for (std::size_t i = 0; i < a.coverage.size(); ++i) EXPECT_NEAR(a.coverage[i], b.coverage[i], 2e-3) << width;
    }
}

TEST(Capsule, JointsOfABendHaveNeitherGapsNorBeads) {
    // A circle of many short segments against the ring that it is.
    for (const float width : {0.5f, 2.0f, 9.0f, 30.0f}) {
        TaperedLine line;
        for (int i = 0; i <= 90; ++i) {
            const float angle = float(i) * 2 * std::numbers::pi_v<float> / 90;
            line.push_back({{50 + 30 * std::cos(angle), 50 + 30 * std::sin(angle)}, width});
        }
        const CoveragePlane p = painted(line, 100);
        for (int y = 0; y < 100; ++y)
            for (int x = 0; x < 75; ++x) {  // clear of the ends on the right
                const double off = std::abs(std::hypot(x + 0.5 - 50, y + 0.5 - 50) - 30) - width / 2;
                const float c = p.coverage[std::size_t(y * 100 + x)];
                if (off < -0.75) {
                    EXPECT_EQ(c, 1) << x << ' ' << y;
                }
                if (off > 0.75) {
                    EXPECT_EQ(c, 0) << x << ' ' << y;
                }
            }
        EXPECT_NEAR(ink(p) / (2 * std::numbers::pi * 30 * width), 1, 0.01) << width;
    }
}

TEST(Capsule, NothingIsPaintedOutsideTheHull) {
    for (const float width : {0.2f, 1.3f, 8.0f}) {
        const TaperedLine line = centred(40, width, 20);
        const CoveragePlane p = painted(line, 100);
        const Vec2f ab = line[1].at - line[0].at;
        for (int y = 0; y < 100; ++y)
            for (int x = 0; x < 100; ++x) {
                const Vec2f q{float(x) + 0.5f, float(y) + 0.5f};
                const float t = std::clamp(dot(q - line[0].at, ab) / dot(ab, ab), 0.0f, 1.0f);
                const float away = distance(q, line[0].at + ab * t) - width / 2;
                if (away > std::numbers::sqrt2_v<float> / 2) {
                    EXPECT_EQ(p.coverage[std::size_t(y * 100 + x)], 0);
                }
            }
    }
}

TEST(Capsule, ADiscInsideItsNeighbourChangesNothing) {
    const CoveragePlane alone = painted({{{50, 50}, 20}}, 100);
    const CoveragePlane both = painted({{{50, 50}, 20}, {{53, 50}, 4}}, 100);
    for (std::size_t i = 0; i < alone.coverage.size(); ++i) EXPECT_NEAR(alone.coverage[i], both.coverage[i], 2e-3);
}

}  // namespace
}  // namespace dstylize
