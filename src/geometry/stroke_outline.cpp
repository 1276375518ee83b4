// One side is walked forwards, then the other as the same side of the reversed line. A side is a chain of
// offset edges; where two meet they get a corner, an arc or a detour through the centreline.
#include "geometry/stroke_outline.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dstylize {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kWidestStep = kPi / 8;

float cross(Vec2f a, Vec2f b) { return a.x * b.y - a.y * b.x; }

class Outliner {
  public:
    explicit Outliner(float tolerance) : tolerance_(tolerance) {}

    std::vector<Vec2f> outline(TaperedLine line) {
        if (line.size() == 1) {
            disc(line[0]);
            return std::move(points_);
        }
        TaperedLine back(line.rbegin(), line.rend());
        side(line);
        arc(line.back(), normal(line, line.size() - 2), normal(back, 0));
        side(back);
        arc(back.back(), normal(back, back.size() - 2), normal(line, 0));
        return std::move(points_);
    }

  private:
    /// Unit normal of the offset edge of segment i; leans towards the thinner end.
    static Vec2f normal(const TaperedLine& line, std::size_t i) {
        const Vec2f run = line[i + 1].at - line[i].at;
        const float distance = length(run);
        const Vec2f along = run * (1 / distance);
        const float lean = std::clamp(0.5f * (line[i].width - line[i + 1].width) / distance, -1.0f, 1.0f);
        return along * lean + perpendicular(along) * std::sqrt(1 - lean * lean);
    }

    static Vec2f offset(const WidthPoint& p, Vec2f normal) { return p.at + normal * (0.5f * p.width); }

    void side(const TaperedLine& line) {
        points_.push_back(offset(line[0], normal(line, 0)));
        for (std::size_t i = 1; i + 1 < line.size(); ++i) {
            const float room =
                0.45f * std::min(distance(line[i - 1].at, line[i].at), distance(line[i].at, line[i + 1].at));
            joint(line[i], normal(line, i - 1), normal(line, i), room);
        }
        points_.push_back(offset(line.back(), normal(line, line.size() - 2)));
    }

    void joint(const WidthPoint& p, Vec2f in, Vec2f out, float room) {
        const float radius = 0.5f * p.width, sine = cross(in, out), cosine = dot(in, out);
        const bool inner = sine > 0;
        if (cosine > 0) {
            const Vec2f middle = normalized(in + out);
            const float half_cosine = std::sqrt(0.5f * (1 + cosine)), half_sine = std::sqrt(0.5f * (1 - cosine));
            const bool near_enough = radius * (1 / half_cosine - 1) <= tolerance_;
            const bool fits = radius * half_sine <= room * half_cosine;
            if (inner ? fits : near_enough) {
                points_.push_back(p.at + middle * (radius / half_cosine));
                return;
            }
        }
        points_.push_back(offset(p, in));
        if (inner)
            points_.push_back(p.at);
        else
            arc(p, in, out);
        points_.push_back(offset(p, out));
    }

    /// The points between two offsets of p, from one normal to the other on the outside.
    void arc(const WidthPoint& p, Vec2f from, Vec2f to) {
        float sweep = std::atan2(-cross(from, to), dot(from, to));
        if (sweep < 0) sweep += 2 * kPi;
        const int steps = arc_steps(0.5f * p.width, sweep);
        for (int k = 1; k < steps; ++k) points_.push_back(offset(p, turned(from, -sweep * float(k) / float(steps))));
    }

    int arc_steps(float radius, float sweep) const {
        if (radius <= tolerance_) return 1;
        const float step = std::min(kWidestStep, 2 * std::acos(1 - tolerance_ / radius));
        return int(std::ceil(sweep / step));
    }

    void disc(const WidthPoint& p) {
        const int steps = std::max(8, arc_steps(0.5f * p.width, 2 * kPi));
        for (int k = 0; k < steps; ++k)
            points_.push_back(offset(p, turned({1, 0}, -2 * kPi * float(k) / float(steps))));
    }

    static Vec2f turned(Vec2f v, float angle) {
        const float c = std::cos(angle), s = std::sin(angle);
        return {v.x * c - v.y * s, v.x * s + v.y * c};
    }

    float tolerance_;
    std::vector<Vec2f> points_;
};

}  // namespace

std::vector<Vec2f> stroke_outline(std::span<const WidthPoint> line, float tolerance) {
    TaperedLine clean;
    for (const WidthPoint& p : line)
        if (clean.empty() || distance(clean.back().at, p.at) > 0)
            clean.push_back(p);
        else
            clean.back().width = std::max(clean.back().width, p.width);
    if (std::ranges::none_of(clean, [](const WidthPoint& p) { return p.width > 0; })) return {};
    return Outliner(tolerance).outline(std::move(clean));
}

}  // namespace dstylize
