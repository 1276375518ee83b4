// Leaves where they help: they give empty backgrounds life and say "vine" at once; on faces and in
// textures they would be clutter.
#include "metaphor/leaves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/noise.h"
#include "core/sampling.h"

namespace dstylize {
namespace {

constexpr std::array kSizes{1.0f, 0.77f, 0.57f};  // tried in this order, the first that fits is taken

/// Half the width of a leaf at share t of its length.
float half_width(float t, float length, float aspect) {
    return 0.5f * aspect * length * std::sin(std::numbers::pi_v<float> * std::pow(t, 0.8f));
}

/// Which cells of the lattice are covered by ink or leaves.
class Cover {
  public:
    Cover(Extent extent, float px_per_cell) : cells_(extent, 0), px_per_cell_(px_per_cell) {}

    bool free(Vec2f p_px) const {
        const int i = int(p_px.x / px_per_cell_), j = int(p_px.y / px_per_cell_);
        return i >= 2 && j >= 2 && i < cells_.extent().x - 2 && j < cells_.extent().y - 2 && !cells_(i, j);
    }
    void mark(Vec2f p_px) {
        const int i = int(p_px.x / px_per_cell_), j = int(p_px.y / px_per_cell_);
        if (cells_.extent().contains(i, j)) cells_(i, j) = 1;
    }
    void mark(const VariableStroke& stroke) {
        for (std::size_t k = 0; k < stroke.points_px.size(); ++k) {
            const float radius = 0.5f * stroke.width_px[k];
            for (float dy = -radius; dy <= radius; dy += px_per_cell_)
                for (float dx = -radius; dx <= radius; dx += px_per_cell_) mark(stroke.points_px[k] + Vec2f{dx, dy});
            mark(stroke.points_px[k]);
            if (k > 0) mark(lerp(stroke.points_px[k - 1], stroke.points_px[k], 0.5f));
        }
    }

  private:
    Grid<std::uint8_t> cells_;
    float px_per_cell_;
};

class Placement {
  public:
    Placement(const Subject& subject, const LeafParameters& p)
        : subject_(subject),
          p_(p),
          calm_(subject.field("calm")),
          cover_(calm_.extent(), subject.px_per_node),
          noise_(subject.seed, Purpose::leaves) {
        for (const VariableStroke& stroke : subject.strokes) cover_.mark(stroke);
    }

    std::vector<Leaf> leaves() {
        for (const VariableStroke& stroke : subject_.strokes) at_tip(stroke);
        for (const VariableStroke& stroke : subject_.strokes) along_stem(stroke);
        if (int(leaves_.size()) < p_.at_least) leaves_.clear();
        return std::move(leaves_);
    }

  private:
    float random() { return noise_.unit(counter_++); }
    bool calm_at(Vec2f p_px) const { return sample(calm_, p_px * (1 / subject_.px_per_node)) > 0; }

    void at_tip(const VariableStroke& stroke) {
        const std::size_t n = stroke.points_px.size();
        if (n < 6 || !calm_at(stroke.points_px.back())) return;
        const Vec2f way = stroke.points_px[n - 1] - stroke.points_px[n - 4];
        try_sizes(stroke.points_px.back(), std::atan2(way.y, way.x) + (random() - 0.5f) * 0.5f, 1);
    }

    void along_stem(const VariableStroke& stroke) {
        constexpr float kRetry_u = 2, kLessThanTip = 0.92f;
        const std::size_t n = stroke.points_px.size();
        if (n < 7) return;
        float next = 0.9f * p_.spacing * random() * subject_.u_px, arc = 0;
        float side = random() < 0.5f ? 1.0f : -1.0f;
        for (std::size_t k = 3; k + 3 < n; ++k) {
            arc += distance(stroke.points_px[k], stroke.points_px[k - 1]);
            if (arc < next || stroke.width_px[k] > p_.stem * subject_.u_px || !calm_at(stroke.points_px[k])) continue;
            const Vec2f way = normalized(stroke.points_px[k + 2] - stroke.points_px[k - 2]);
            const float turn = side * (p_.angle_deg + 17 * (random() - 0.5f)) * std::numbers::pi_v<float> / 180;
            const float angle = std::atan2(way.y, way.x) + turn;
            const Vec2f base =
                stroke.points_px[k] + Vec2f{std::cos(angle), std::sin(angle)} * (0.4f * stroke.width_px[k]);
            if (try_sizes(base, angle, kLessThanTip)) {
                arc = 0;
                next = (0.6f + 0.8f * random()) * p_.spacing * subject_.u_px;
            } else {
                next = arc + kRetry_u * subject_.u_px;
            }
            side = -side;
        }
    }

    bool try_sizes(Vec2f base, float angle, float scale) {
        for (const float size : kSizes) {
            const float length = size * scale * p_.size * subject_.u_px;
            if (!fits(base, angle, length)) continue;
            visit_cells(base, angle, length, [&](Vec2f p) {
                cover_.mark(p);
                return true;
            });
            leaves_.push_back({base, angle, length, (random() - 0.5f) * 0.25f * length});
            return true;
        }
        return false;
    }

    bool fits(Vec2f base, float angle, float length) const {
        return visit_cells(base, angle, length, [&](Vec2f p) { return cover_.free(p); });
    }

    /// Calls `visit` on points all over the leaf and the gap around it; stops at the first false.
    template <class Visit>
    bool visit_cells(Vec2f base, float angle, float length, Visit visit) const {
        const Vec2f along{std::cos(angle), std::sin(angle)}, across = perpendicular(along);
        const float step = 0.5f * subject_.px_per_node;
        for (float s = 0.18f * length; s <= 1.12f * length; s += step) {
            const float half = half_width(std::min(1.0f, s / length), length, p_.aspect) + p_.gap * subject_.u_px;
            for (float q = -half; q <= half; q += step)
                if (!visit(base + along * s + across * q)) return false;
        }
        return true;
    }

    const Subject& subject_;
    const LeafParameters& p_;
    const Grid<float>& calm_;
    Cover cover_;
    Noise noise_;
    std::uint64_t counter_ = 0;
    std::vector<Leaf> leaves_;
};

std::vector<Vec2f> leaf_outline(const Leaf& leaf, float aspect) {
    constexpr int kSegments = 14;
    const Vec2f along{std::cos(leaf.angle_rad), std::sin(leaf.angle_rad)}, across = perpendicular(along);
    std::vector<Vec2f> outline;
    const auto add = [&](float t, float side) {
        const float bend = leaf.bend_px * t * (1 - t) * 2;
        outline.push_back(leaf.base_px + along * (t * leaf.length_px) +
                          across * (side * half_width(t, leaf.length_px, aspect) + bend));
    };
    for (int k = 0; k <= kSegments; ++k) add(float(k) / kSegments, 1);
    for (int k = kSegments - 1; k > 0; --k) add(float(k) / kSegments, -1);
    return outline;
}

}  // namespace

void LeafParameters::visit(ParameterVisitor& v) {
    v.flag({"leaves", "", "leaves in calm bright parts"}, grow);
    v.colour({"leaf_fill", "", "colour of the leaves"}, fill);
    v.number({"leaf_size", "u", "length of the largest leaves"}, size, 2, 100);
    v.number({"leaf_aspect", "", "width of a leaf by its length"}, aspect, 0.1f, 1);
    v.number({"leaf_gap", "u", "least distance to ink and other leaves"}, gap, 0, 20);
    v.number({"leaf_spacing", "u", "distance between leaves along a stem"}, spacing, 2, 200);
    v.number({"leaf_angle", "deg", "angle between leaf and stem"}, angle_deg, 10, 90);
    v.number({"leaf_stem", "u", "widest stem that carries leaves"}, stem, 0.2f, 20);
    v.number({"leaf_outline", "u", "width of a leaf's outline"}, outline, 0, 5);
    v.integer({"leaf_at_least", "", "draw none when fewer than this fit"}, at_least, 0, 10000);
}

std::vector<Leaf> placed_leaves(const Subject& subject, const LeafParameters& parameters) {
    if (!parameters.grow) return {};
    return Placement(subject, parameters).leaves();
}

void add_leaf_layers(DisplayList& list, const std::vector<Leaf>& leaves, const LeafParameters& p, Rgba ink,
                     float u_px) {
    if (leaves.empty()) return;
    constexpr float kMidribShare = 0.8f;
    Layer fills{"leaves", Blend::over, {}}, lines{"leaf outlines", Blend::max, {}};
    for (const Leaf& leaf : leaves) {
        std::vector<Vec2f> outline = leaf_outline(leaf, p.aspect);
        const Vec2f along{std::cos(leaf.angle_rad), std::sin(leaf.angle_rad)};
        const Vec2f rib_end = leaf.base_px + along * (kMidribShare * leaf.length_px) +
                              perpendicular(along) * (leaf.bend_px * kMidribShare * (1 - kMidribShare) * 2);
        VariableStroke contour{outline, {}, ink, 0, 0};
        contour.points_px.push_back(outline.front());
        contour.width_px.assign(contour.points_px.size(), p.outline * u_px);
        fills.items.push_back(Fill{std::move(outline), p.fill});
        lines.items.push_back(std::move(contour));
        lines.items.push_back(
            VariableStroke{{leaf.base_px, rib_end}, {p.outline * u_px, 0.4f * p.outline * u_px}, ink, 0, 0});
    }
    list.layers.insert(list.layers.begin(), std::move(fills));
    list.layers.push_back(std::move(lines));
}

}  // namespace dstylize
