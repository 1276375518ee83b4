// Lichen writing: the dendrite as a foliose thallus on stone. Lobes swell and turn pale towards their tips,
// old parts fill in between them, brown cups sit here and there; relief, shadow and the stone's own grain come
// from the layer effect Relief. Xu & Mould 2007, fig. 13; lichens after Desbenoit et al. 2004.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/noise.h"
#include "metaphor/metaphor.h"
#include "metaphor/stone_ground.h"

namespace dstylize {
namespace {

constexpr Rgba rgb(int r, int g, int b) { return {float(r) / 255, float(g) / 255, float(b) / 255, 1}; }

struct Species {
    Rgba thallus, tip, old, cup;
};
constexpr Species kSage{rgb(124, 134, 100), rgb(212, 220, 186), rgb(88, 96, 76), rgb(118, 66, 36)};
constexpr Species kOrange{rgb(208, 118, 22), rgb(252, 196, 58), rgb(140, 70, 20), rgb(186, 66, 12)};
constexpr Species kSlate{rgb(52, 56, 50), rgb(96, 104, 92), rgb(34, 36, 32), rgb(24, 20, 18)};

class Lichen final : public Metaphor {
  public:
    void visit(ParameterVisitor& v) override {
        static constexpr std::array<std::string_view, 5> kKinds{"auto", "sage", "orange", "slate", "own"};
        choice(v, {"species", "", "colours; auto: what stands out from the stone; own: those below"}, kind_, kKinds);
        v.colour({"thallus", "", "own species: the limbs"}, own_.thallus);
        v.colour({"tip", "", "own species: the tips of the lobes"}, own_.tip);
        v.colour({"old", "", "own species: old parts, and what fills the gaps"}, own_.old);
        v.colour({"cup", "", "own species: the fruit"}, own_.cup);
        v.number({"swell", "", "how much wider lobes are at their tips"}, swell_, 0, 2);
        v.number({"swell_length", "u", "over which length they are"}, swell_length_, 0.5f, 60);
        v.number({"height", "", "how high lobes rise, as a share of their half width"}, height_, 0, 2);
        v.number({"roughness", "", "of their skin"}, roughness_, 0, 3);
        v.number({"light_angle", "deg", "where the light comes from, clockwise from the right"}, light_angle_deg_, 0,
                 360);
        v.number({"gap", "", "how solid the gaps between lobes are filled: foliose low, crusty high"}, gap_, 0, 1);
        v.number({"gap_reach", "u", "how wide a gap is filled"}, gap_reach_, 0.5f, 40);
        v.number({"shadow", "", "darkness of the cast shadow"}, shadow_, 0, 1);
        v.number({"shadow_length", "u", "length of the cast shadow"}, shadow_length_, 0, 40);
        v.number({"contact", "", "darkness where the lichen meets the stone"}, contact_, 0, 1);
        v.number({"drape", "", "how much the lichen follows the grain of the stone"}, drape_, 0, 2);
        v.number({"cups", "", "fruit for every hundred lobes"}, cups_, 0, 100);
    }

    DisplayList draw(const Subject& subject) const override {
        const Ground ground = ground_below(subject);
        const Species species = chosen(ground);
        DisplayList list{subject.width_px, subject.height_px, {rgb(88, 85, 84), 0, subject.seed}, {}};
        if (ground.is_paper()) list.paper.picture = basalt(subject);
        Layer thallus{"thallus", Blend::max, {}};
        for (VariableStroke stroke : subject.strokes) {
            stroke.colour = species.thallus;
            swell(stroke, subject.u_px);
            thallus.items.push_back(std::move(stroke));
        }
        thallus.relief = relief(subject, species);
        list.layers.push_back(std::move(thallus));
        if (cups_ > 0) list.layers.push_back(fruit(subject, species));
        return list;
    }

  private:
    enum class Kind { automatic, sage, orange, slate, own };

    /// Luma of the picture where the letters are.
    struct Ground {
        float mean = 1, deviation = 0;
        bool is_paper() const { return mean >= 0.97f; }
    };
    static Ground ground_below(const Subject& subject) {
        const Grid<float>&luma = subject.field("luma"), &shape = subject.field("shape");
        double area = 0, sum = 0, squares = 0;
        for (std::size_t n = 0; n < luma.size(); ++n) {
            area += double(shape[n]);
            sum += double(luma[n]) * double(shape[n]);
            squares += double(luma[n]) * double(luma[n]) * double(shape[n]);
        }
        if (area <= 0) return {};
        const double mean = sum / area;
        return {float(mean), float(std::sqrt(std::max(0.0, squares / area - mean * mean)))};
    }

    /// Sage only stands out from what is dark and even; orange from all but the palest.
    Species chosen(const Ground& ground) const {
        constexpr float kDark = 0.36f, kEven = 0.13f, kPale = 0.70f;
        switch (kind_) {
            case Kind::sage: return kSage;
            case Kind::orange: return kOrange;
            case Kind::slate: return kSlate;
            case Kind::own: return own_;
            case Kind::automatic: break;
        }
        if (ground.is_paper() || (ground.mean < kDark && ground.deviation < kEven)) return kSage;
        return ground.mean < kPale ? kOrange : kSlate;
    }

    void swell(VariableStroke& stroke, float u_px) const {
        const float decay = swell_length_ * u_px;
        float to_tip = 0;
        for (std::size_t k = stroke.points_px.size(); k-- > 0;) {
            if (k + 1 < stroke.points_px.size()) to_tip += distance(stroke.points_px[k], stroke.points_px[k + 1]);
            stroke.width_px[k] *= 1 + swell_ * std::exp(-to_tip / decay);
        }
    }

    Relief relief(const Subject& subject, const Species& species) const {
        const float u = subject.u_px, angle = light_angle_deg_ * 3.14159265f / 180;
        std::vector<float> widths;
        for (const VariableStroke& stroke : subject.strokes)
            widths.push_back(stroke.width_px[stroke.width_px.size() / 2]);
        float typical = 5 * u;
        if (!widths.empty()) {
            const auto middle = widths.begin() + std::ptrdiff_t(widths.size() / 2);
            std::nth_element(widths.begin(), middle, widths.end());
            typical = *middle;
        }
        Relief r;
        r.tip = species.tip;
        r.tip_length_px = 13 * u;
        r.radius_px = typical / 2;
        r.height = height_;
        r.roughness = roughness_;
        r.light = 0.85f * Vec2f{std::cos(angle), std::sin(angle)};
        r.gap_colour = species.old;
        r.gap = gap_;
        r.gap_sigma_px = gap_reach_ * u;
        r.shadow = shadow_;
        r.shadow_length_px = shadow_length_ * u;
        r.shadow_sigma_px = 1.2f * u;
        r.contact = contact_;
        r.contact_sigma_px = 9 * u;
        r.drape = drape_;
        r.drape_sigma_px = 16 * u;
        r.seed = subject.seed;
        return r;
    }

    /// Cups on the older parts: a pale rim around a dark disc.
    Layer fruit(const Subject& subject, const Species& species) const {
        constexpr float kLeast_u = 2.0f, kMore_u = 1.6f, kApart = 4;
        constexpr int kCorners = 14;
        const Noise noise(subject.seed, Purpose::leaves);
        Layer out{"cups", Blend::over, {}};
        std::vector<Vec2f> placed;
        for (std::size_t s = 0; s < subject.strokes.size(); ++s) {
            const VariableStroke& stroke = subject.strokes[s];
            if (stroke.points_px.size() < 4 || 100 * noise.unit(4 * s) >= cups_) continue;
            const Vec2f at =
                stroke.points_px[std::size_t(noise.unit(4 * s + 1) * 0.6f * float(stroke.points_px.size()))];
            const float radius = (kLeast_u + kMore_u * noise.unit(4 * s + 2)) * subject.u_px;
            if (std::any_of(placed.begin(), placed.end(), [&](Vec2f p) { return distance(p, at) < kApart * radius; }))
                continue;
            placed.push_back(at);
            const auto disc = [&](float r, Rgba colour) {
                Fill fill{{}, colour};
                for (int k = 0; k < kCorners; ++k) {
                    const float turn = 6.2831853f * float(k) / kCorners;
                    const float wobble = 1 + 0.14f * (noise.unit(1000003 * (s + 1) + std::size_t(k)) - 0.5f);
                    fill.outline_px.push_back(at + r * wobble * Vec2f{std::cos(turn), std::sin(turn)});
                }
                out.items.emplace_back(std::move(fill));
            };
            disc(radius, species.tip);
            disc(0.66f * radius, species.cup);
        }
        return out;
    }

    Kind kind_ = Kind::automatic;
    Species own_ = kSage;
    float swell_ = 0.45f, swell_length_ = 8, height_ = 0.72f, roughness_ = 0.5f, light_angle_deg_ = 230;
    float gap_ = 0.75f, gap_reach_ = 2.7f;
    float shadow_ = 0.55f, shadow_length_ = 3.2f, contact_ = 0.55f, drape_ = 0.8f, cups_ = 4;
};

}  // namespace

std::unique_ptr<Metaphor> make_lichen() { return std::make_unique<Lichen>(); }

}  // namespace dstylize
