#include "metaphor/foliage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/noise.h"
#include "core/sampling.h"

namespace dstylize {
namespace {

float unit(std::uint32_t bits) { return Noise::unit_of(bits); }

/// A colour as its luma and what red and blue have beyond it.
struct Tint {
    float luma = 0, red = 0, blue = 0;
};

Tint tint(Rgba c) {
    const float y = luma(c);
    return {y, c.r - y, c.b - y};
}

Rgba colour(Tint t) {
    const float r = t.luma + t.red, b = t.luma + t.blue, g = (t.luma - 0.299f * r - 0.114f * b) / 0.587f;
    const auto in_range = [](float v) { return std::clamp(v, 0.0f, 1.0f); };
    return {in_range(r), in_range(g), in_range(b), 1};
}

/// `from` with the hue of `to` by that share, at its own luma and the saturation that `to` has.
Tint tinted(Tint from, Tint to, float share) {
    const float saturation = std::clamp(from.luma / std::max(0.02f, to.luma), 0.4f, 1.7f);
    from.red += (to.red * saturation - from.red) * share;
    from.blue += (to.blue * saturation - from.blue) * share;
    return from;
}

/// What colours a leaf has: the style's by tone, some still green in patches, all nearer to the picture's own hue.
class LeafColours {
  public:
    LeafColours(const Subject& subject, const FoliageParameters& p)
        : subject_(subject),
          p_(p),
          patches_(subject.seed, Purpose::leaves, 2),
          light_(tint(p.leaf_light)),
          middle_(tint(p.leaf_middle)),
          dark_(tint(p.leaf_dark)),
          green_(tint(p.leaf_green)) {
        // The quantile of what `ripe` is: nearly normal, about 1/2.
        constexpr float kSpread = 0.19f, kLogisticToNormal = 0.62f;
        const float share = std::clamp(p.green_share, 1e-4f, 1 - 1e-4f);
        green_below_ = 0.5f + kSpread * kLogisticToNormal * std::log(share / (1 - share));
    }

    /// `dark` in [0, 1]; `leads`: how far the picture does; `random`: 32 bits each.
    Tint at(Vec2f at_px, float dark, float leads, const std::array<std::uint32_t, 4>& random) const {
        const float t = 2 * dark;
        const Tint &a = t < 1 ? light_ : middle_, &b = t < 1 ? middle_ : dark_;
        const float s = t < 1 ? t : t - 1;
        Tint out{a.luma + (b.luma - a.luma) * s, a.red + (b.red - a.red) * s, a.blue + (b.blue - a.blue) * s};
        const float ripe = 0.65f * patch(at_px) + 0.35f * unit(random[0]);
        out = tinted(out, green_, smoothstep(green_below_ + 0.08f, green_below_ - 0.08f, ripe));
        const float turn = p_.hue_variety * (unit(random[1]) + unit(random[2]) - 1) * 3.14159265f / 180;
        const float red = out.red * std::cos(turn) - out.blue * std::sin(turn);
        out.blue = out.red * std::sin(turn) + out.blue * std::cos(turn);
        out.red = red;
        return own(out, at_px, leads);
    }

  private:
    /// Nearer to the hue of its place, and no less saturated than it was.
    Tint own(Tint t, Vec2f at_px, float leads) const {
        if (subject_.no_picture || p_.own_hue <= 0) return t;
        constexpr int kReach = 1;  // samples to each side: a leaf has the mean colour of its place
        constexpr float kSamples = (2 * kReach + 1) * (2 * kReach + 1);
        constexpr float kMostGain = 1.6f;
        const Vec2f middle = (at_px - subject_.picture_corner_px) * (1 / subject_.picture_scale);
        Rgba sum{0, 0, 0, 0};
        for (int j = -kReach; j <= kReach; ++j)
            for (int i = -kReach; i <= kReach; ++i) {
                const float apart = 0.33f * p_.leaf_size * subject_.u_px / subject_.picture_scale;
                const Rgba8 p = sample(*subject_.picture, middle + Vec2f{float(i), float(j)} * apart);
                const float share = float(p.a) / (255 * kSamples);
                sum.r += share * float(p.r) / 255, sum.g += share * float(p.g) / 255, sum.b += share * float(p.b) / 255;
                sum.a += share;
            }
        if (sum.a <= 0) return t;
        const Tint here = tint({sum.r / sum.a, sum.g / sum.a, sum.b / sum.a, 1});
        // A grey place has no hue to give.
        const float vivid = smoothstep(0.02f, 0.12f, std::hypot(here.red, here.blue));
        Tint out = tinted(t, here, p_.own_hue * leads * vivid * sum.a);
        const float was = std::hypot(t.red, t.blue), is = std::hypot(out.red, out.blue);
        const float gain = is > 0 ? std::clamp(was / is, 1.0f, kMostGain) : 1;
        out.red *= gain;
        out.blue *= gain;
        return out;
    }

    /// Smooth value noise in [0, 1].
    float patch(Vec2f at_px) const {
        constexpr float kCell_u = 62;
        const Vec2f q = at_px * (1 / (kCell_u * subject_.u_px));
        const float i = std::floor(q.x), j = std::floor(q.y);
        const auto corner = [&](float x, float y) {
            return patches_.unit(std::uint64_t(std::uint32_t(std::int32_t(y))) << 32 | std::uint32_t(std::int32_t(x)));
        };
        const float fx = smoothstep(0, 1, q.x - i), fy = smoothstep(0, 1, q.y - j);
        const float top = corner(i, j) + (corner(i + 1, j) - corner(i, j)) * fx;
        const float bottom = corner(i, j + 1) + (corner(i + 1, j + 1) - corner(i, j + 1)) * fx;
        return top + (bottom - top) * fy;
    }

    const Subject& subject_;
    const FoliageParameters& p_;
    Noise patches_;
    Tint light_, middle_, dark_, green_;
    float green_below_;
};

/// Counts on a coarse grid over the frame.
class Cells {
  public:
    Cells(const Subject& subject, float cell_px)
        : cell_px_(cell_px), marks_({int(subject.width_px / cell_px) + 1, int(subject.height_px / cell_px) + 1}) {}

    std::uint8_t at(Vec2f p_px) const {
        const Vec2f cell = p_px * (1 / cell_px_);
        return sample(marks_, cell);
    }
    void count(Vec2f p_px) {
        const Extent e = marks_.extent();
        std::uint8_t& n =
            marks_(std::clamp(int(p_px.x / cell_px_), 0, e.x - 1), std::clamp(int(p_px.y / cell_px_), 0, e.y - 1));
        n = std::uint8_t(std::min(255, n + 1));
    }
    void mark_disc(Vec2f p_px, float radius_px) {
        const Extent e = marks_.extent();
        const auto cell = [&](float v, int side) { return std::clamp(int(v / cell_px_), 0, side - 1); };
        for (int j = cell(p_px.y - radius_px, e.y); j <= cell(p_px.y + radius_px, e.y); ++j)
            for (int i = cell(p_px.x - radius_px, e.x); i <= cell(p_px.x + radius_px, e.x); ++i)
                if (distance(middle(i, j), p_px) <= radius_px) marks_(i, j) = 1;
    }
    Vec2f middle(int i, int j) const { return Vec2f{float(i) + 0.5f, float(j) + 0.5f} * cell_px_; }
    /// How many of the cell's eight neighbours are marked.
    int neighbours(int i, int j) const {
        int out = 0;
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x)
                out += (x != 0 || y != 0) && marks_.extent().contains(i + x, j + y) && marks_(i + x, j + y) > 0;
        return out;
    }
    float cell_px() const { return cell_px_; }
    const Grid<std::uint8_t>& marks() const { return marks_; }

  private:
    float cell_px_;
    Grid<std::uint8_t> marks_;
};

/// Hangs leaves on the twigs of a subject, then closes the holes among them.
class Leafing {
  public:
    Leafing(const Subject& subject, const FoliageParameters& p, Vec2f light)
        : subject_(subject),
          p_(p),
          light_(light),
          tone_(subject.field("tone")),
          inside_(subject.field("crown")),
          noise_(subject.seed, Purpose::leaves, 1),
          colours_(subject, p),
          boughs_(subject, std::max(1.0f, subject.u_px)),
          leafy_(subject, std::max(1.0f, 0.8f * p.leaf_size * subject.u_px)),
          shaded_(leafy_) {
        for (const VariableStroke& limb : subject.strokes)
            for (std::size_t k = 0; k < limb.points_px.size(); ++k)
                if (limb.width_px[k] > p.leaf_twig * subject.u_px && limb.layer == 0)
                    boughs_.mark_disc(limb.points_px[k], limb.width_px[k] / 2);
    }

    Foliage leaves() {
        for (const VariableStroke& twig : subject_.strokes) along(twig);
        fill_holes();
        return {layer("leaves behind", behind_), layer("leaves", front_)};
    }

  private:
    struct Placed {
        Vec2f base_px, direction;
        float length_px, bend, depth;  // depth 0: the foremost
        Rgba colour;
    };

    void along(const VariableStroke& twig) {
        const float u = subject_.u_px, gap = p_.leaf_size * u / std::max(0.01f, p_.foliage);
        float way = gap * noise_.unit(1u << 31 | count_);
        for (std::size_t k = 1; k < twig.points_px.size(); ++k) {
            const Vec2f step = twig.points_px[k] - twig.points_px[k - 1];
            way -= length(step);
            const bool tip = k + 1 == twig.points_px.size();
            if (twig.width_px[k] > p_.leaf_twig * u || (way > 0 && !tip)) continue;
            way = gap;
            const auto random = noise_.block(count_ + 1);
            const float turn = (count_ % 2 == 0 ? 1.0f : -1.0f) * (tip ? 0.5f : 1.2f) * (0.3f + unit(random[0]));
            const Vec2f way_on = normalized(step);
            add(twig.points_px[k], way_on * std::cos(turn) + perpendicular(way_on) * std::sin(turn),
                twig.layer > 0 ? Place::behind : Place::by_chance);
        }
    }

    /// Leaves in front where a cell without lies among cells with some, then a dense ground of leaves behind all.
    void fill_holes() {
        constexpr int kPasses = 16;
        for (int pass = 0; pass < kPasses; ++pass)
            for (const Vec2f at : holes(leafy_, 1)) fill(at, 1, Place::front);
        constexpr float kLarge = 1.6f;
        constexpr int kDense = 3;
        for (int enough = 1; enough <= kDense; ++enough)
            for (const Vec2f at : holes(shaded_, enough)) fill(at, kLarge, Place::behind);
    }

    /// Middles of well enclosed cells with fewer than `enough` leaves.
    std::vector<Vec2f> holes(const Cells& cells, int enough) const {
        constexpr int kAround = 4;
        constexpr float kWellInside = 0.5f;
        const Extent e = cells.marks().extent();
        std::vector<Vec2f> out;
        for (int j = 0; j < e.y; ++j)
            for (int i = 0; i < e.x; ++i)
                if (cells.marks()(i, j) < enough && leafy_.neighbours(i, j) >= kAround &&
                    noise_.unit(std::uint64_t{1} << 42 | std::uint64_t(j) << 20 | std::uint64_t(i)) < p_.leaf_fill &&
                    sample(inside_, cells.middle(i, j) * (1 / subject_.px_per_node)) > kWellInside)
                    out.push_back(cells.middle(i, j));
        return out;
    }

    enum class Place { front, behind, by_chance };

    void fill(Vec2f middle_px, float scale, Place place) {
        constexpr float kAside = 0.8f;  // of a cell: rows of cells must not be seen
        const auto random = noise_.block(count_ | std::uint64_t{1} << 43);
        const float angle = 6.2831853f * unit(random[0]);
        middle_px = middle_px + Vec2f{unit(random[1]) - 0.5f, unit(random[2]) - 0.5f} * (kAside * leafy_.cell_px());
        const Vec2f direction{std::cos(angle), std::sin(angle)};
        add(middle_px - direction * (0.5f * scale * p_.leaf_size * subject_.u_px), direction, place, scale);
    }

    void add(Vec2f base_px, Vec2f direction, Place place, float scale = 1) {
        const auto random = noise_.block(++count_), more = noise_.block(count_ | std::uint64_t{1} << 40),
                   hue = noise_.block(count_ | std::uint64_t{1} << 41);
        const float size = scale * p_.leaf_size * subject_.u_px * (0.75f + 0.5f * unit(random[2]));
        Placed leaf{base_px, direction, size, 0.3f * (unit(random[3]) - 0.5f), unit(more[0]), {}};
        const Vec2f middle = base_px + direction * (size / 2), node = middle * (1 / subject_.px_per_node);
        if (place != Place::behind) leafy_.count(middle);
        const bool behind = place == Place::behind || (place == Place::by_chance && unit(more[3]) < p_.leaf_under) ||
                            (boughs_.at(middle) > 0 && unit(hue[3]) < p_.boughs_seen);
        if (behind) shaded_.count(middle);
        const float leads = p_.leaf_likeness * smoothstep(0.2f, 0.7f, sample(inside_, node));
        const float chance = p_.leaf_variety * (unit(random[1]) + unit(more[2]) - 1);
        const float dark = std::clamp(leads * sample(tone_, node) + (1 - leads) * 0.45f + chance, 0.0f, 1.0f);
        const Tint t = colours_.at(middle, dark, leads, hue);
        const float lit = (1 + p_.leaf_depth * (0.4f - leaf.depth)) * (behind ? 1 - p_.under_shade : 1);
        leaf.colour = colour({t.luma * lit, t.red * lit, t.blue * lit});
        (behind ? behind_ : front_).push_back(leaf);
    }

    /// From its stalk on, pointed at both ends, a little bent; then the half that faces the light.
    void draw(const Placed& leaf, std::vector<Item>& items) const {
        constexpr std::array<float, 5> kAt{0.18f, 0.4f, 0.6f, 0.8f, 0.93f},
            kHalfWidth{0.55f, 0.98f, 0.96f, 0.6f, 0.25f};
        Vec2f side = perpendicular(leaf.direction);
        const float length = leaf.length_px, half = p_.leaf_aspect * length / 2;
        const auto spine = [&, bent = side * (leaf.bend * length)](float t) {
            return leaf.base_px + leaf.direction * (t * length) + bent * (t * t);
        };
        if (dot(side, light_) < 0) side = side * -1.0f;
        Fill whole{{leaf.base_px}, leaf.colour};
        for (std::size_t k = 0; k < kAt.size(); ++k)
            whole.outline_px.push_back(spine(kAt[k]) + side * (kHalfWidth[k] * half));
        whole.outline_px.push_back(spine(1));
        Fill lit{whole.outline_px, leaf.colour};
        for (std::size_t k = kAt.size(); k-- > 0;)
            whole.outline_px.push_back(spine(kAt[k]) - side * (kHalfWidth[k] * half));
        items.emplace_back(std::move(whole));
        if (p_.leaf_fold <= 0) return;
        lit.outline_px.push_back(spine(kAt[2]));
        for (float* c : {&lit.colour.r, &lit.colour.g, &lit.colour.b}) *c = std::min(1.0f, *c * (1 + p_.leaf_fold));
        items.emplace_back(std::move(lit));
    }

    Layer layer(const char* name, std::vector<Placed>& leaves) const {
        std::stable_sort(leaves.begin(), leaves.end(),
                         [](const Placed& a, const Placed& b) { return a.depth > b.depth; });
        Layer out{name, Blend::over, {}};
        out.items.reserve(2 * leaves.size());
        for (const Placed& leaf : leaves) draw(leaf, out.items);
        return out;
    }

    const Subject& subject_;
    const FoliageParameters& p_;
    Vec2f light_;
    const Grid<float>&tone_, &inside_;
    Noise noise_;
    LeafColours colours_;
    Cells boughs_, leafy_, shaded_;
    std::vector<Placed> behind_, front_;
    std::uint64_t count_ = 0;
};

}  // namespace

void FoliageParameters::visit(ParameterVisitor& v) {
    v.number({"foliage", "", "leaves per leaf length of twig; 0 leaves the tree bare"}, foliage, 0, 4);
    v.number({"leaf_size", "u", "length of a leaf"}, leaf_size, 1, 60);
    v.number({"leaf_aspect", "", "its width as a share of its length"}, leaf_aspect, 0.1f, 1);
    v.number({"leaf_twig", "u", "twigs thinner than this bear leaves"}, leaf_twig, 0.2f, 20);
    v.number({"leaf_fill", "", "share of the holes among leaves that more leaves close"}, leaf_fill, 0, 1);
    v.number({"boughs_seen", "", "share of the leaves before a bough that lie behind it instead"}, boughs_seen, 0, 1);
    v.colour({"leaf_light", "", "colour of leaves where the picture is light"}, leaf_light);
    v.colour({"leaf_middle", "", "colour of leaves where it is neither light nor dark"}, leaf_middle);
    v.colour({"leaf_dark", "", "colour of leaves where it is dark"}, leaf_dark);
    v.colour({"leaf_green", "", "hue of leaves that have not turned yet"}, leaf_green);
    v.number({"green_share", "", "share of leaves that have not, in patches"}, green_share, 0, 1);
    v.number({"leaf_likeness", "", "how far the picture says which leaves are dark"}, leaf_likeness, 0, 1);
    v.number({"leaf_variety", "", "how much the tones of leaves differ by chance"}, leaf_variety, 0, 1);
    v.number({"hue_variety", "deg", "how much their hues differ by chance"}, hue_variety, 0, 90);
    v.number({"own_hue", "", "how far leaves have the picture's own hues"}, own_hue, 0, 1);
    v.number({"leaf_depth", "", "how much darker than the foremost leaves the deepest are"}, leaf_depth, 0, 1);
    v.number({"leaf_fold", "", "how much lighter the half of a leaf that faces the light is"}, leaf_fold, 0, 1);
    v.number({"leaf_under", "", "share of leaves behind the branches"}, leaf_under, 0, 1);
    v.number({"under_shade", "", "how much darker those are"}, under_shade, 0, 1);
}

Foliage foliage(const Subject& subject, const FoliageParameters& parameters, Vec2f light) {
    return Leafing(subject, parameters, light).leaves();
}

}  // namespace dstylize
