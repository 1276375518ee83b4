// A tree with round, furrowed limbs, and grass at its foot.
#include <algorithm>
#include <cmath>

#include "core/noise.h"
#include "metaphor/bark.h"
#include "metaphor/foliage.h"

namespace dstylize {
namespace {

class Tree final : public Metaphor {
  public:
    void visit(ParameterVisitor& v) override {
        v.colour({"paper", "", "colour of the ground"}, paper_);
        v.number({"grain", "", "lightness noise of the paper, on raster outputs up to 4 megapixels"}, grain_, 0, 0.2f);
        bark_.visit(v);
        foliage_.visit(v);
        v.number({"grass", "", "how densely grass hides the foot of the trunk"}, grass_, 0, 4);
        v.colour({"grass_colour", "", "colour of the grass"}, grass_colour_);
    }
    DisplayList draw(const Subject& subject) const override {
        DisplayList list{subject.width_px, subject.height_px, {paper_, grain_, subject.seed}, {}};
        list.layers = bark_layers(subject, bark_);
        if (foliage_.foliage > 0) {
            const float from = bark_.light_deg * 3.14159265f / 180;
            Foliage leaves = foliage(subject, foliage_, {std::cos(from), std::sin(from)});
            const auto front = list.layers.empty() ? list.layers.end() : list.layers.end() - 1;
            list.layers.insert(front, std::move(leaves.behind));
            list.layers.push_back(std::move(leaves.front));
        }
        if (grass_ > 0) list.layers.push_back(grass(subject));
        return list;
    }

  private:
    /// Blades in front of every foot: dense in its middle, none where it does not stand.
    Layer grass(const Subject& subject) const {
        Layer layer{"grass", Blend::over, {}};
        layer.of_ground = true;
        const Noise noise(subject.seed, Purpose::leaves);
        const float u = subject.u_px;
        std::uint64_t draw = 0;
        for (const VariableStroke& stroke : subject.strokes) {
            const std::size_t last = stroke.points_px.size() - 1;
            if (stroke.order != 0 || last == 0 ||
                stroke.points_px[std::min<std::size_t>(last, 8)].y > stroke.points_px[0].y)
                continue;
            const float foot = std::max(8 * u, stroke.width_px[0]);
            const int blades = int(grass_ * (70 + 12 * foot / u));
            for (int k = 0; k < blades; ++k) {
                const auto random = noise.block(2 * draw), more = noise.block(2 * draw + 1);
                ++draw;
                const auto unit = Noise::unit_of;
                // Denser and taller before the trunk, whose round end it hides.
                const float t = (unit(random[0]) + unit(random[1]) + unit(more[2])) / 1.5f - 1;
                const float near_trunk = std::exp(-9 * t * t);
                const float tall = (6 + 12 * unit(random[2])) * u + near_trunk * (0.25f + 0.5f * unit(more[3])) * foot;
                const float lean = (unit(random[3]) - 0.5f + 0.5f * t) * 0.7f * tall;
                const float below = (0.45f - 0.25f * t * t + 0.12f * unit(more[0])) * foot;
                const Vec2f at = stroke.points_px[0] + Vec2f{3.2f * t * foot, below};
                VariableStroke blade;
                blade.points_px = {at, at + Vec2f{0.25f * lean, -0.6f * tall}, at + Vec2f{lean, -tall}};
                blade.width_px = {2.0f * u, 1.4f * u, 0.3f * u};
                blade.colour = grass_colour_;
                const float light = 0.6f + 0.8f * unit(more[1]);
                for (float* c : {&blade.colour.r, &blade.colour.g, &blade.colour.b}) *c = std::min(1.0f, *c * light);
                layer.items.emplace_back(std::move(blade));
            }
        }
        return layer;
    }

    Rgba paper_{0xf2 / 255.0f, 0xe9 / 255.0f, 0xd6 / 255.0f, 1};
    float grain_ = 0.006f;
    BarkParameters bark_;
    FoliageParameters foliage_;
    float grass_ = 1;
    Rgba grass_colour_{0x35 / 255.0f, 0x2d / 255.0f, 0x22 / 255.0f, 1};
};

}  // namespace

std::unique_ptr<Metaphor> make_tree() { return std::make_unique<Tree>(); }

}  // namespace dstylize
