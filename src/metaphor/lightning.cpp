// The picture made of lightning on a dark ground that keeps a hint of it (004 s. 4.5, fig. 9 right).
#include <array>
#include <cmath>

#include "metaphor/glow_layer.h"

namespace dstylize {
namespace {

class Lightning final : public Metaphor {
  public:
    Lightning() {
        glow_.ambient = 0.45f;
        glow_.cast = 2.5f;
    }
    void visit(ParameterVisitor& v) override {
        v.colour({"ground", "", "colour of the darkest ground"}, ground_);
        v.colour({"hint", "", "colour of the picture that is left in the ground"}, hint_);
        v.number({"hint_gain", "", "light of that picture; 0: a plain ground"}, hint_gain_, 0, 8);
        v.number({"hint_gamma", "", "above 1 keeps its mid-tones dark"}, hint_gamma_, 0.5f, 4);
        glow_.visit(v);
    }
    DisplayList draw(const Subject& subject) const override {
        DisplayList list{subject.width_px, subject.height_px, {ground_, 0, subject.seed}, {}};
        list.paper.picture = std::make_shared<Picture>(hinted(*subject.picture));
        list.layers.push_back(glow_layer(subject, glow_));
        return list;
    }

  private:
    Picture hinted(const Picture& picture) const {
        const auto light = [&](float encoded) { return -std::log(std::max(1e-3f, 1 - encoded)) / glow_.exposure; };
        const float floor = 1 / std::max(0.05f, glow_.ambient);  // the darkest ground is meant as it is
        std::array<Rgba8, 256> graded;
        for (int v = 0; v < 256; ++v) {
            const float hint = hint_gain_ * std::pow(float(v) / 255, hint_gamma_);
            graded[std::size_t(v)] =
                exposed_ground({floor * light(ground_.r) + hint * hint_.r, floor * light(ground_.g) + hint * hint_.g,
                                floor * light(ground_.b) + hint * hint_.b},
                               glow_.exposure, 255);
        }
        Picture out(picture.extent());
        for (std::size_t n = 0; n < out.size(); ++n) {
            const Rgba8 p = picture[n];
            out[n] = graded[std::size_t((299 * p.r + 587 * p.g + 114 * p.b + 500) / 1000)];
            out[n].a = p.a;
        }
        return out;
    }

    Rgba ground_{0x05 / 255.0f, 0x06 / 255.0f, 0x0f / 255.0f, 1};
    Rgba hint_{0x16 / 255.0f, 0x21 / 255.0f, 0x4a / 255.0f, 1};
    float hint_gain_ = 1.5f, hint_gamma_ = 1.7f;
    GlowParameters glow_;
};

}  // namespace

std::unique_ptr<Metaphor> make_lightning() { return std::make_unique<Lightning>(); }

}  // namespace dstylize
