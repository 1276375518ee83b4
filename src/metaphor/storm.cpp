// Great bolts over the picture itself, which turns to night and is lit up where they strike (000 s. 4.3,
// fig. 4.12).
#include <algorithm>
#include <array>
#include <cmath>

#include "metaphor/glow_layer.h"

namespace dstylize {
namespace {

class Storm final : public Metaphor {
  public:
    Storm() {
        glow_.core = {0.6f, 0.78f, 1, 1};
        glow_.core_gain = 2.6f;
        glow_.ambient = 0.38f;
        glow_.cast = 9;
        glow_.cast_radius = 65;
    }
    void visit(ParameterVisitor& v) override {
        v.colour({"night", "", "tint of the night"}, night_);
        v.number({"night_gain", "", "light of the tinted picture"}, gain_, 0, 4);
        v.number({"day_colour", "", "share of the picture's own colours that stays"}, day_, 0, 1);
        v.number({"night_white", "", "luma that the picture's brightest parts are brought to; 0: left as they are"},
                 white_, 0, 1);
        v.number({"night_gamma", "", "above 1 deepens the shadows"}, gamma_, 0.5f, 4);
        glow_.visit(v);
    }
    DisplayList draw(const Subject& subject) const override {
        DisplayList list{subject.width_px, subject.height_px, {{0, 0, 0, 1}, 0, subject.seed}, {}};
        list.paper.picture = std::make_shared<Picture>(night(*subject.picture));
        list.layers.push_back(glow_layer(subject, glow_));
        return list;
    }

  private:
    Picture night(const Picture& picture) const {
        constexpr int kLevels = 512;
        const float level = levelling(picture);
        std::vector<float> light(kLevels + 1);
        for (int k = 0; k <= kLevels; ++k) light[std::size_t(k)] = std::pow(2 * float(k) / kLevels, gamma_);
        const auto graded = [&](float own, float grey, float tint) {
            const float q = level * (day_ * own + (1 - day_) * grey * gain_ * tint);
            return light[std::size_t(std::min(float(kLevels), 0.5f * kLevels * q))];
        };
        Picture out(picture.extent());
        for (std::size_t n = 0; n < out.size(); ++n) {
            const Rgba8 p = picture[n];
            const Rgba c{float(p.r) / 255, float(p.g) / 255, float(p.b) / 255, 1};
            const float grey = luma(c);
            out[n] =
                exposed_ground({graded(c.r, grey, night_.r), graded(c.g, grey, night_.g), graded(c.b, grey, night_.b)},
                               glow_.exposure, p.a);
        }
        return out;
    }

    /// What brings the luma that 2 % of the picture exceed to `night_white`; within bounds, for night
    /// photographs have nothing but grain to brighten.
    float levelling(const Picture& picture) const {
        constexpr double kBright = 0.98;
        constexpr float kLeast = 0.8f, kMost = 2;
        if (white_ <= 0) return 1;
        std::array<std::size_t, 256> count{};
        for (const Rgba8 p : picture) ++count[std::size_t((299 * p.r + 587 * p.g + 114 * p.b + 500) / 1000)];
        int level = 0;
        for (std::size_t seen = count[0]; level < 255 && double(seen) < kBright * double(picture.size());)
            seen += count[std::size_t(++level)];
        return std::clamp(white_ * 255 / float(std::max(1, level)), kLeast, kMost);
    }

    Rgba night_{0xa3 / 255.0f, 0xc2 / 255.0f, 1, 1};
    float gain_ = 1.25f, day_ = 0.35f, white_ = 0.95f, gamma_ = 2;
    GlowParameters glow_;
};

}  // namespace

std::unique_ptr<Metaphor> make_storm() { return std::make_unique<Storm>(); }

}  // namespace dstylize
