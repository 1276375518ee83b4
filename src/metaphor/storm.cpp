// Great bolts over the picture itself, which turns to night and is lit up where they strike (000 s. 4.3,
// fig. 4.12).
#include <cmath>

#include "metaphor/glow_layer.h"

namespace dstylize {
namespace {

class Storm final : public Metaphor {
  public:
    Storm() {
        glow_.ambient = 0.25f;
        glow_.cast = 3.5f;
    }
    void visit(ParameterVisitor& v) override {
        v.colour({"night", "", "tint of the night"}, night_);
        v.number({"night_gain", "", "light of the tinted picture"}, gain_, 0, 4);
        v.number({"day_colour", "", "share of the picture's own colours that stays"}, day_, 0, 1);
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
        std::vector<float> light(kLevels + 1);
        for (int k = 0; k <= kLevels; ++k) light[std::size_t(k)] = std::pow(2 * float(k) / kLevels, gamma_);
        const auto graded = [&](float own, float grey, float tint) {
            const float q = day_ * own + (1 - day_) * grey * gain_ * tint;
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

    Rgba night_{0xa3 / 255.0f, 0xc2 / 255.0f, 1, 1};
    float gain_ = 1.25f, day_ = 0.35f, gamma_ = 2;
    GlowParameters glow_;
};

}  // namespace

std::unique_ptr<Metaphor> make_storm() { return std::make_unique<Storm>(); }

}  // namespace dstylize
