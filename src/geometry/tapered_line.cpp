#include "geometry/tapered_line.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <utility>

namespace dstylize {
namespace {

constexpr float kCuspCosine = 0.5f;  // of 60 degrees
constexpr int kMostPieces = 64;
/// Points nearer to each other are one: their directions would be rounding noise.
constexpr float kSamePoint = 1e-5f;

TaperedLine without_repeats(std::span<const Vec2f> points, std::span<const float> widths) {
    TaperedLine line;
    line.reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const float width = std::max(widths[i], 0.0f);
        if (!line.empty() && distance(line.back().at, points[i]) < kSamePoint)
            line.back().width = std::max(line.back().width, width);
        else
            line.push_back({points[i], width});
    }
    return line;
}

/// Whether the curve breaks at point i: an end, or a turn sharper than the corner angle.
bool is_corner(const TaperedLine& line, std::size_t i) {
    if (i == 0 || i + 1 == line.size()) return true;
    const Vec2f in = line[i].at - line[i - 1].at, out = line[i + 1].at - line[i].at;
    return dot(in, out) < kCuspCosine * length(in) * length(out);
}

/// Derivative at the middle of three points for a parameter that runs from 0 to 1 over a segment of
/// centripetal length `span`.
Vec2f tangent(Vec2f before, Vec2f here, Vec2f after, float span) {
    const float t0 = std::sqrt(distance(before, here)), t1 = std::sqrt(distance(here, after));
    return ((here - before) * (1 / t0) - (after - before) * (1 / (t0 + t1)) + (after - here) * (1 / t1)) * span;
}

/// Slope of the width per unit length at point i: 0 at an extremum, else the harmonic mean.
float width_slope(const TaperedLine& line, std::size_t i) {
    auto secant = [&](std::size_t j) {
        return (line[j + 1].width - line[j].width) / distance(line[j].at, line[j + 1].at);
    };
    if (i == 0) return secant(0);
    if (i + 1 == line.size()) return secant(i - 1);
    const float a = secant(i - 1), b = secant(i);
    return a * b > 0 ? 2 * a * b / (a + b) : 0.0f;
}

struct Hermite {
    Vec2f p0, p1, m0, m1;
    float w0, w1, s0, s1;

    WidthPoint at(float t) const {
        const float t2 = t * t, t3 = t2 * t;
        const float a = 2 * t3 - 3 * t2 + 1, b = t3 - 2 * t2 + t, c = 3 * t2 - 2 * t3, d = t3 - t2;
        return {p0 * a + m0 * b + p1 * c + m1 * d, std::max(0.0f, w0 * a + s0 * b + w1 * c + s1 * d)};
    }
    /// How far the curve and the width may leave the chord, from above.
    float deviation() const {
        const Vec2f chord = p1 - p0, across = perpendicular(normalized(chord));
        const float side = std::max(std::abs(dot(m0, across)), std::abs(dot(m1, across))) / 3;
        const float swell = std::max(std::abs(s0 - (w1 - w0)), std::abs(s1 - (w1 - w0))) / 6;
        return 0.75f * std::max(side, swell);
    }
};

Hermite segment(const TaperedLine& line, std::size_t i) {
    const Vec2f p0 = line[i].at, p1 = line[i + 1].at, chord = p1 - p0;
    const float chord_length = length(chord), span = std::sqrt(chord_length);
    const bool free0 = is_corner(line, i), free1 = is_corner(line, i + 1);
    Vec2f m0 = chord, m1 = chord;
    if (!free0) m0 = tangent(line[i - 1].at, p0, p1, span);
    if (!free1) m1 = tangent(p0, p1, line[i + 2].at, span);
    // A free end carries no bending of its own: a parabola that meets the other end's tangent.
    if (free0 && !free1) m0 = chord * 2 - m1;
    if (free1 && !free0) m1 = chord * 2 - m0;
    return {p0,
            p1,
            m0,
            m1,
            line[i].width,
            line[i + 1].width,
            width_slope(line, i) * chord_length,
            width_slope(line, i + 1) * chord_length};
}

/// Distance of `p` from the segment ab in (x, y, half width).
float deviation(const WidthPoint& p, const WidthPoint& a, const WidthPoint& b) {
    const Vec2f ab = b.at - a.at, ap = p.at - a.at;
    const float squared = dot(ab, ab);
    const float t = squared > 0 ? std::clamp(dot(ap, ab) / squared, 0.0f, 1.0f) : 0.0f;
    const Vec2f off = ap - ab * t;
    const float half = 0.5f * (p.width - (a.width + (b.width - a.width) * t));
    return std::sqrt(dot(off, off) + half * half);
}

}  // namespace

TaperedLine smooth_line(std::span<const Vec2f> points, std::span<const float> widths, float tolerance) {
    assert(points.size() == widths.size() && tolerance > 0);
    TaperedLine line = without_repeats(points, widths);
    if (line.size() < 3) return line;
    TaperedLine dense;
    dense.reserve(line.size() * 2);
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Hermite curve = segment(line, i);
        const float wanted = std::ceil(std::sqrt(curve.deviation() / tolerance));
        const int pieces = int(std::clamp(wanted, 1.0f, float(kMostPieces)));
        dense.push_back(line[i]);
        for (int k = 1; k < pieces; ++k) dense.push_back(curve.at(float(k) / float(pieces)));
    }
    dense.push_back(line.back());
    return dense;
}

TaperedLine simplified(std::span<const WidthPoint> line, float tolerance) {
    if (line.size() < 3) return TaperedLine(line.begin(), line.end());
    std::vector<std::uint8_t> keep(line.size(), 0);
    keep.front() = keep.back() = 1;
    std::vector<std::pair<std::size_t, std::size_t>> open{{0, line.size() - 1}};
    while (!open.empty()) {
        const auto [first, last] = open.back();
        open.pop_back();
        float worst = tolerance;
        std::size_t split = 0;
        for (std::size_t i = first + 1; i < last; ++i) {
            const float d = deviation(line[i], line[first], line[last]);
            if (d > worst) worst = d, split = i;
        }
        if (split == 0) continue;
        keep[split] = 1;
        open.emplace_back(first, split);
        open.emplace_back(split, last);
    }
    TaperedLine kept;
    for (std::size_t i = 0; i < line.size(); ++i)
        if (keep[i]) kept.push_back(line[i]);
    return kept;
}

}  // namespace dstylize
