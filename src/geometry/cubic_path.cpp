// Schneider's fit: least squares for the lengths of the two end tangents, a few rounds of
// reparametrization, and a split at the worst point where that is not enough.
#include "geometry/cubic_path.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dstylize {
namespace {

constexpr float kCornerCosine = 0.766f;  // of 40 degrees
constexpr int kReparametrizations = 4;
/// Lines are held to a part of the tolerance: a chord that replaces a faint curve kinks at its ends.
constexpr float kStraightShare = 0.3f;

struct Cubic {
    std::array<Vec2f, 4> p;

    Vec2f at(float t) const {
        const float s = 1 - t;
        return p[0] * (s * s * s) + p[1] * (3 * s * s * t) + p[2] * (3 * s * t * t) + p[3] * (t * t * t);
    }
    Vec2f first_derivative(float t) const {
        const float s = 1 - t;
        return ((p[1] - p[0]) * (s * s) + (p[2] - p[1]) * (2 * s * t) + (p[3] - p[2]) * (t * t)) * 3;
    }
    Vec2f second_derivative(float t) const {
        return ((p[2] - p[1] * 2 + p[0]) * (1 - t) + (p[3] - p[2] * 2 + p[1]) * t) * 6;
    }
};

std::vector<float> chord_lengths(std::span<const Vec2f> points) {
    std::vector<float> t(points.size(), 0.0f);
    for (std::size_t i = 1; i < points.size(); ++i) t[i] = t[i - 1] + distance(points[i - 1], points[i]);
    for (float& v : t) v /= t.back();
    t.back() = 1;
    return t;
}

/// The cubic with the given end tangents (both point into the curve) that is nearest at parameters t.
Cubic least_squares(std::span<const Vec2f> points, const std::vector<float>& t, Vec2f tangent0, Vec2f tangent1) {
    const Vec2f first = points.front(), last = points.back();
    double c00 = 0, c01 = 0, c11 = 0, x0 = 0, x1 = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const float u = t[i], s = 1 - u;
        const float b0 = s * s * s, b1 = 3 * s * s * u, b2 = 3 * s * u * u, b3 = u * u * u;
        const Vec2f a0 = tangent0 * b1, a1 = tangent1 * b2;
        const Vec2f rest = points[i] - first * (b0 + b1) - last * (b2 + b3);
        c00 += dot(a0, a0), c01 += dot(a0, a1), c11 += dot(a1, a1);
        x0 += dot(a0, rest), x1 += dot(a1, rest);
    }
    const double det = c00 * c11 - c01 * c01;
    const float chord = distance(first, last), third = chord / 3;
    float alpha0 = third, alpha1 = third;
    if (std::abs(det) > 1e-9 * c00 * c11) {
        alpha0 = float((x0 * c11 - x1 * c01) / det);
        alpha1 = float((c00 * x1 - c01 * x0) / det);
        // Negative or tiny handles make loops; very long ones cusps.
        const float least = 1e-3f * chord, most = 3 * chord + 1e-6f;
        if (!(alpha0 > least && alpha0 < most && alpha1 > least && alpha1 < most)) alpha0 = alpha1 = third;
    }
    return {{first, first + tangent0 * alpha0, last + tangent1 * alpha1, last}};
}

struct Misfit {
    float distance = 0;
    std::size_t index = 0;
};

/// Measured at the corners and half-way between them, where a curve could bulge from a long edge.
Misfit misfit(std::span<const Vec2f> points, const std::vector<float>& t, const Cubic& curve) {
    Misfit worst{0, points.size() / 2};
    for (std::size_t i = 1; i < points.size(); ++i) {
        const Vec2f edge = normalized(points[i] - points[i - 1]), half = curve.at(0.5f * (t[i - 1] + t[i]));
        const float bulge = std::abs(dot(half - points[i], perpendicular(edge)));
        const float miss = distance(curve.at(t[i]), points[i]);
        if (bulge > worst.distance) worst = {bulge, i};
        if (miss > worst.distance) worst = {miss, i};
    }
    return worst;
}

/// One Newton step of every parameter towards its nearest point.
void reparametrize(std::span<const Vec2f> points, std::vector<float>& t, const Cubic& curve) {
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        const Vec2f off = curve.at(t[i]) - points[i], d1 = curve.first_derivative(t[i]);
        const float slope = dot(d1, d1) + dot(off, curve.second_derivative(t[i]));
        if (slope > 0) t[i] = std::clamp(t[i] - dot(off, d1) / slope, 0.0f, 1.0f);
    }
}

bool is_straight(std::span<const Vec2f> points, float tolerance) {
    const Vec2f chord = points.back() - points.front();
    const float squared = dot(chord, chord);
    for (const Vec2f p : points) {
        const Vec2f off = p - points.front();
        const float t = squared > 0 ? std::clamp(dot(off, chord) / squared, 0.0f, 1.0f) : 0.0f;
        if (length(off - chord * t) > tolerance) return false;
    }
    return true;
}

class Fitter {
  public:
    Fitter(CubicPath& path, float tolerance) : path_(path), tolerance_(tolerance) {}

    void fit(std::span<const Vec2f> points, Vec2f tangent0, Vec2f tangent1) {
        if (points.size() == 2 || is_straight(points, kStraightShare * tolerance_)) {
            path_.pieces.push_back({{}, {}, points.back(), true});
            return;
        }
        std::vector<float> t = chord_lengths(points);
        Misfit worst;
        for (int round = 0; round <= kReparametrizations; ++round) {
            const Cubic curve = least_squares(points, t, tangent0, tangent1);
            worst = misfit(points, t, curve);
            if (worst.distance <= tolerance_) {
                path_.pieces.push_back({curve.p[1], curve.p[2], curve.p[3]});
                return;
            }
            if (worst.distance > 8 * tolerance_) break;
            reparametrize(points, t, curve);
        }
        const std::size_t split = std::clamp<std::size_t>(worst.index, 1, points.size() - 2);
        const Vec2f way = normalized(points[split + 1] - points[split - 1]);
        fit(points.first(split + 1), tangent0, way * -1);
        fit(points.subspan(split), way, tangent1);
    }

  private:
    CubicPath& path_;
    float tolerance_;
};

std::vector<Vec2f> distinct(std::span<const Vec2f> polygon, float least) {
    std::vector<Vec2f> points;
    for (const Vec2f p : polygon)
        if (points.empty() || distance(points.back(), p) > least) points.push_back(p);
    while (points.size() > 1 && distance(points.back(), points.front()) <= least) points.pop_back();
    return points;
}

}  // namespace

CubicPath fitted_path(std::span<const Vec2f> polygon, float tolerance) {
    std::vector<Vec2f> points = distinct(polygon, 0.02f * tolerance);
    const std::size_t n = points.size();
    if (n < 3) return {};
    const auto is_corner = [&](std::size_t i) {
        const Vec2f in = points[i] - points[(i + n - 1) % n], out = points[(i + 1) % n] - points[i];
        return dot(in, out) < kCornerCosine * length(in) * length(out);
    };
    std::vector<std::size_t> breaks;
    for (std::size_t i = 0; i < n; ++i)
        if (is_corner(i)) breaks.push_back(i);
    const bool smooth_all_round = breaks.empty();
    if (smooth_all_round) breaks.push_back(0);

    CubicPath path{points[breaks[0]], {}};
    Fitter fitter(path, tolerance);
    std::vector<Vec2f> run;
    for (std::size_t b = 0; b < breaks.size(); ++b) {
        const std::size_t first = breaks[b], last = b + 1 < breaks.size() ? breaks[b + 1] : breaks[0] + n;
        run.clear();
        for (std::size_t i = first; i <= last; ++i) run.push_back(points[i % n]);
        Vec2f tangent0 = normalized(run[1] - run[0]), tangent1 = normalized(run[run.size() - 2] - run.back());
        if (smooth_all_round) {
            tangent0 = normalized(run[1] - run[run.size() - 2]);
            tangent1 = tangent0 * -1;
        }
        fitter.fit(run, tangent0, tangent1);
    }
    return path;
}

}  // namespace dstylize
