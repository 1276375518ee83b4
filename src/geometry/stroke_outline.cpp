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
constexpr float kWidestMiter = kPi / 3;

float cross(Vec2f a, Vec2f b) { return a.x * b.y - a.y * b.x; }

/// What a segment contributes to a side: its direction, and the lean of its offset edge's normal, the sine
/// of the angle by which it points forwards because the stroke thins.
struct Edge {
    Vec2f along;
    float lean;
    float length;  ///< of the offset edge

    Edge(const WidthPoint& a, const WidthPoint& b) {
        const float run = distance(a.at, b.at);
        along = (b.at - a.at) * (1 / run);
        lean = std::clamp(0.5f * (a.width - b.width) / run, -1.0f, 1.0f);
        length = run * std::sqrt(1 - lean * lean);
    }
    Vec2f normal() const { return along * lean + perpendicular(along) * std::sqrt(1 - lean * lean); }
};

/// How far the normal turns from one edge to the next; negative on the outer side of a bend. A reversal of
/// direction counts as outer, which makes a round end of it.
float normal_turn(const Edge& in, const Edge& out) {
    const float sine = cross(in.along, out.along), cosine = dot(in.along, out.along);
    const float bend = sine == 0 && cosine < 0 ? -kPi : std::atan2(sine, cosine);
    return bend + std::asin(in.lean) - std::asin(out.lean);
}

class Outliner {
  public:
    explicit Outliner(float tolerance) : tolerance_(tolerance) {}

    std::vector<Vec2f> outline(TaperedLine line) {
        if (line.size() == 1) {
            disc(line[0]);
        } else {
            side(line);
            std::ranges::reverse(line);
            side(line);
        }
        return std::move(points_);
    }

  private:
    static Vec2f offset(const WidthPoint& p, Vec2f normal) { return p.at + normal * (0.5f * p.width); }

    /// The side towards `perpendicular`, and the end that follows it.
    void side(const TaperedLine& line) {
        Edge in(line[0], line[1]);
        points_.push_back(offset(line[0], in.normal()));
        for (std::size_t i = 1; i + 1 < line.size(); ++i) {
            const Edge out(line[i], line[i + 1]);
            joint(line[i], in, out);
            in = out;
        }
        points_.push_back(offset(line.back(), in.normal()));
        arc(line.back(), in.normal(), 2 * std::asin(in.lean) - kPi);
    }

    void joint(const WidthPoint& p, const Edge& in, const Edge& out) {
        const float radius = 0.5f * p.width, turn = normal_turn(in, out);
        if (std::abs(turn) < kWidestMiter) {
            const float slope = std::tan(0.5f * std::abs(turn)), reach = std::sqrt(1 + slope * slope);
            const bool near_enough = radius * (reach - 1) <= tolerance_;
            // The next joint may take as much of the same edge.
            const bool fits = radius * slope <= 0.45f * std::min(in.length, out.length);
            if (fits && (turn > 0 || near_enough)) {
                points_.push_back(offset(p, normalized(in.normal() + out.normal()) * reach));
                return;
            }
        }
        points_.push_back(offset(p, in.normal()));
        if (turn > 0)
            points_.push_back(p.at);
        else
            arc(p, in.normal(), turn);
        points_.push_back(offset(p, out.normal()));
    }

    /// The points on the disc of p that lie between a normal and where it turns to.
    void arc(const WidthPoint& p, Vec2f from, float turn) {
        const int steps = arc_steps(0.5f * p.width, std::abs(turn));
        for (int k = 1; k < steps; ++k) points_.push_back(offset(p, turned(from, turn * float(k) / float(steps))));
    }

    int arc_steps(float radius, float turn) const {
        if (radius <= tolerance_) return 1;
        const float step = std::min(kWidestStep, 2 * std::acos(1 - tolerance_ / radius));
        return int(std::ceil(turn / step));
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
