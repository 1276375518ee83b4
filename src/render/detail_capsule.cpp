#include "render/detail_capsule.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace dstylize {
namespace {

constexpr float kThinEndRun = 1.5f;
constexpr float kUnbounded = 1e9f;
/// Half the diagonal of a sample: nothing farther from an edge is partly covered.
constexpr float kReach = 0.7072f;

/// A unit square sample seen along a direction: its shadow is a trapezoid of base 2 * half_base and
/// top 2 * half_top.
struct Footprint {
    float half_base, half_top, inverse_long, curvature;

    explicit Footprint(Vec2f direction) {
        const float x = std::abs(direction.x), y = std::abs(direction.y);
        const float longer = std::max(x, y), shorter = std::max(std::min(x, y), 1e-4f);
        half_base = 0.5f * (longer + shorter);
        half_top = 0.5f * (longer - shorter);
        inverse_long = 1 / longer;
        curvature = 1 / (2 * longer * shorter);
    }
    /// Share of the sample within `x` of its centre along the direction, minus one half.
    float share(float x) const {
        const float size = std::abs(x), rest = std::max(half_base - size, 0.0f);
        const float middle = size * inverse_long, flank = 0.5f - rest * rest * curvature;
        return std::copysign(size < half_top ? middle : flank, x);
    }
};

/// One segment in the tile's frame, with what its rows need.
struct Capsule {
    Vec2f from, along;                       ///< start; unit direction
    float length, radius;                    ///< radius at the start
    float taper, slant;                      ///< radius lost per unit of length; foot shift per unit of distance
    float radius_to;                         ///< at the end
    float before, after;                     ///< how far beyond its ends it is painted
    bool cut_from, cut_to;                   ///< square thin ends
    float emission = 1, emission_slope = 0;  ///< factor on the coverage: at the start; per unit of length
};

Vec2f direction(const WidthPoint& a, const WidthPoint& b) { return normalized(b.at - a.at); }

float taper_of(const WidthPoint& a, const WidthPoint& b) {
    const float run = distance(a.at, b.at);
    return run > 0 ? std::min(std::abs(a.width - b.width) * 0.5f / run, 1.0f) : 1.0f;
}

/// How far the wedge at the joint of segments (a, b) and (b, c) reaches along either of them.
float wedge(const WidthPoint& a, const WidthPoint& b, const WidthPoint& c) {
    const Vec2f in = direction(a, b), out = direction(b, c);
    const float sine = dot(in, out) > 0 ? std::abs(dot(perpendicular(in), out)) : 1.0f;
    const float reach = std::min(1.0f, sine + taper_of(a, b) + taper_of(b, c));
    return (0.5f * b.width + kReach) * reach + 0.01f;
}

float cut_length(float radius) { return std::numbers::pi_v<float> * 0.25f * radius; }

Capsule capsule(std::span<const WidthPoint> line, std::size_t i, Vec2f origin) {
    const std::size_t end = line.size() - 1;
    const std::size_t j = std::min(i + 1, end);
    Capsule c{};
    c.from = line[i].at - origin;
    c.along = direction(line[i], line[j]);
    c.length = distance(line[i].at, line[j].at);
    c.radius = 0.5f * line[i].width;
    c.radius_to = 0.5f * line[j].width;
    c.cut_from = i == 0 && c.radius < kThinRadius;
    c.cut_to = j == end && c.radius_to < kThinRadius;
    c.before = i > 0 ? wedge(line[i - 1], line[i], line[j]) : c.radius + kReach;
    c.after = j < end ? wedge(line[i], line[j], line[j + 1]) : c.radius_to + kReach;
    if (c.length == 0) c.along = {1, 0};
    if (std::abs(c.radius - c.radius_to) >= 0.999f * c.length) {
        // One disc holds the other: the larger is all there is.
        if (c.radius_to > c.radius) c.from = line[j].at - origin;
        c.radius = c.radius_to = std::max(c.radius, c.radius_to);
        c.cut_from = c.cut_to = c.radius < kThinRadius;
        c.length = 0;
        c.before = c.after = c.radius + kReach;
    }
    c.taper = c.length > 0 ? (c.radius - c.radius_to) / c.length : 0;
    c.slant = c.taper / std::sqrt(1 - c.taper * c.taper);
    return c;
}

/// One row's samples: position along the segment and across it, at the first one and per sample.
struct RowStart {
    float along, across, along_step, across_step;
};

void keep_largest(float& coverage, std::uint32_t& winner, float candidate, std::uint32_t colour) {
    const bool wins = candidate >= coverage && candidate > kLeastCoverage;
    coverage = wins ? candidate : coverage;
    winner = wins ? colour : winner;
}

/// Wide everywhere: a sample sees at most one edge.
void paint_wide_row(float* coverage, std::uint32_t* winner, int count, const Capsule& c, const Footprint& foot,
                    RowStart row, std::uint32_t colour) {
    for (int i = 0; i < count; ++i) {
        const float s = row.along + float(i) * row.along_step, q = row.across + float(i) * row.across_step;
        const float centre = std::min(std::max(s - std::abs(q) * c.slant, 0.0f), c.length);
        const float ds = s - centre;
        const float outside = std::sqrt(ds * ds + q * q) - (c.radius - centre * c.taper);
        const float emission = c.emission + centre * c.emission_slope;
        keep_largest(coverage[i], winner[i], (0.5f - foot.share(outside)) * emission, colour);
    }
}

/// Any width, and square cuts at thin ends.
void paint_thin_row(float* coverage, std::uint32_t* winner, int count, const Capsule& c, const Footprint& foot,
                    RowStart row, std::uint32_t colour) {
    const float cut_lo = c.cut_from ? -cut_length(c.radius) : -kUnbounded;
    const float cut_hi = c.length + (c.cut_to ? cut_length(c.radius_to) : kUnbounded);
    const float foot_lo = c.cut_from ? -2.0f : 0.0f, foot_hi = c.length + (c.cut_to ? 2.0f : 0.0f);
    for (int i = 0; i < count; ++i) {
        const float s = row.along + float(i) * row.along_step, q = row.across + float(i) * row.across_step;
        const float centre = std::min(std::max(s - std::abs(q) * c.slant, foot_lo), foot_hi);
        const float ds = s - centre;
        const float away = std::sqrt(ds * ds + q * q);
        const float inside = std::min(std::max(centre, 0.0f), c.length);
        const float radius = c.radius - inside * c.taper;
        const float strip = foot.share(away + radius) - foot.share(away - radius);
        const float run = std::min(cut_hi, s + 0.5f) - std::max(cut_lo, s - 0.5f);
        const float emission = c.emission + inside * c.emission_slope;
        keep_largest(coverage[i], winner[i], strip * std::min(std::max(run, 0.0f), 1.0f) * emission, colour);
    }
}

/// The x of a row at which a linear function of x lies between two bounds.
class Slab {
  public:
    Slab(float step, float least, float most)
        : inverse_(std::abs(step) < 1e-6f ? 0 : 1 / step), least_(least), most_(most) {}

    /// Narrows [lo, hi] in the row whose function is `offset` at x = 0.
    void narrow(float& lo, float& hi, float offset) const {
        if (inverse_ == 0) {
            if (offset < least_ || offset > most_) hi = lo - 1;
            return;
        }
        const float a = (least_ - offset) * inverse_, b = (most_ - offset) * inverse_;
        lo = std::max(lo, std::min(a, b));
        hi = std::min(hi, std::max(a, b));
    }

  private:
    float inverse_, least_, most_;
};

void paint_capsule(CoveragePlane& plane, const Capsule& c, std::uint32_t colour) {
    const float reach = std::max(c.radius, c.radius_to) + kReach;
    if (reach <= kReach) return;
    const float before = c.cut_from ? cut_length(c.radius) + 0.5f : c.before;
    const float after = c.cut_to ? cut_length(c.radius_to) + 0.5f : c.after;
    const Vec2f a = c.from - c.along * before, b = c.from + c.along * (c.length + after);
    const float tall = reach * std::abs(c.along.x);
    const float height = float(plane.height);
    const int y0 = int(std::clamp(std::floor(std::min(a.y, b.y) - tall), 0.0f, height));
    const int y1 = int(std::clamp(std::ceil(std::max(a.y, b.y) + tall), 0.0f, height));
    const Footprint foot(perpendicular(c.along));
    const bool wide = std::min(c.radius, c.radius_to) > kReach && !c.cut_from && !c.cut_to;
    const Slab ends(c.along.x, -before, c.length + after), sides(-c.along.y, -reach, reach);
    for (int y = y0; y < y1; ++y) {
        const Vec2f p = Vec2f{0.5f, float(y) + 0.5f} - c.from;
        const float along = dot(p, c.along), across = dot(p, perpendicular(c.along));
        float lo = 0, hi = float(plane.width - 1);
        ends.narrow(lo, hi, along);
        sides.narrow(lo, hi, across);
        if (!(lo <= hi)) continue;
        const int x0 = int(std::ceil(lo)), x1 = int(std::floor(hi)) + 1;
        if (x0 >= x1) continue;
        const RowStart row{along + float(x0) * c.along.x, across - float(x0) * c.along.y, c.along.x, -c.along.y};
        float* coverage = plane.coverage_row(y) + x0;
        std::uint32_t* winner = plane.colour_row(y) + x0;
        (wide ? paint_wide_row : paint_thin_row)(coverage, winner, x1 - x0, c, foot, row, colour);
        plane.dirty.include(x0, y, x1, y + 1);
    }
}

/// Removes what lies within the run before the last point, which stays.
void straighten_end(TaperedLine& line) {
    if (line.size() < 3 || 0.5f * line.back().width >= kThinRadius) return;
    const WidthPoint tip = line.back();
    line.pop_back();
    while (line.size() > 1 && distance(line.back().at, tip.at) < kThinEndRun) line.pop_back();
    line.push_back(tip);
}

}  // namespace

void straighten_thin_ends(TaperedLine& line) {
    straighten_end(line);
    std::reverse(line.begin(), line.end());
    straighten_end(line);
    std::reverse(line.begin(), line.end());
}

void paint_segments(CoveragePlane& plane, std::span<const WidthPoint> line, std::size_t first, std::size_t last,
                    std::uint32_t colour, std::span<const float> emission) {
    assert(!line.empty() && (emission.empty() || emission.size() == line.size()));
    for (std::size_t i = first; i <= last; ++i) {
        Capsule c = capsule(line, i, plane.origin);
        if (!emission.empty()) {
            c.emission = emission[i];
            const float change = emission[std::min(i + 1, line.size() - 1)] - c.emission;
            c.emission_slope = c.length > 0 ? change / c.length : 0;
        }
        paint_capsule(plane, c, colour);
    }
}

}  // namespace dstylize
