// What styles of light owe besides what every style owes: parameters that are seen, a picture that shows
// through, and vector files that hold the light.
#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/lit_ground.h"
#include "pipeline/style_file.h"
#include "pipeline/stylize.h"
#include "render/raster.h"
#include "support/scenes.h"

namespace dstylize {
namespace {

constexpr Extent kScene{160, 120};

Picture picture_of(const std::string& style, const std::vector<Setting>& settings) {
    std::vector<Setting> all{{"lattice.detail", "160"}};
    all.insert(all.end(), settings.begin(), settings.end());
    Picture scene = test::scene(kScene);
    for (std::size_t n = 0; n < scene.size(); ++n) scene[n].b = std::uint8_t(scene[n].b / 2);  // colour to lose
    return raster(stylize(scene, load_style(style, all), {}).list, {kScene}, {});
}

/// Collects a table's parameters as settings that are far from its own values.
class ChangedValues final : public ParameterVisitor {
  public:
    explicit ChangedValues(std::string table) : table_(std::move(table)) {}
    void number(ParameterDoc doc, float& value, float lo, float hi) override {
        // To the farther end, but not beyond what any picture could show.
        const float far =
            value - lo > 0.25f * (hi - lo) ? lo + 1e-3f * (hi - lo) : std::min(hi, 3 * value + 0.3f * (hi - lo));
        add(doc, std::to_string(far));
    }
    void integer(ParameterDoc doc, int& value, int lo, int hi) override {
        add(doc, std::to_string(value > lo ? lo : hi));
    }
    void flag(ParameterDoc doc, bool& value) override { add(doc, value ? "false" : "true"); }
    void choice(ParameterDoc, int&, std::span<const std::string_view>) override {}
    void colour(ParameterDoc doc, Rgba&) override { add(doc, "#ff8800"); }
    void text(ParameterDoc, std::string&) override {}
    void field_weights(ParameterDoc, FieldWeights&) override {}
    void section(std::string_view, std::string_view, const std::function<void(ParameterVisitor&)>&) override {}

    std::vector<Setting> settings;

  private:
    void add(ParameterDoc doc, std::string value) {
        settings.push_back({table_ + "." + std::string(doc.key), std::move(value)});
    }
    std::string table_;
};

class LightStyles : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, LightStyles, ::testing::Values("lightning", "storm"));

TEST_P(LightStyles, EveryParameterOfTheLightIsSeen) {
    Style style = load_style(GetParam());
    ChangedValues changes(GetParam());
    style.metaphor->visit(changes);
    ASSERT_GT(changes.settings.size(), 20u);
    // These three are weights of what a style may leave out: they are tried where they are in.
    const std::vector<Setting> base{
        {GetParam() + ".shine_tone", "0.5"}, {GetParam() + ".shine", "0.1"}, {GetParam() + ".shine_limbs", "0.8"}};
    const Picture before = picture_of(GetParam(), base);
    for (const Setting& change : changes.settings) {
        std::vector<Setting> settings = base;
        settings.push_back(change);
        EXPECT_NE(picture_of(GetParam(), settings), before) << change.key << " = " << change.value;
    }
}

TEST_P(LightStyles, EveryParameterOfTheGrowthIsSeen) {
    const Picture before = picture_of(GetParam(), {});
    const std::string stage = GetParam() == "storm" ? "stage.branches." : "stage.hairs.";
    for (const Setting& change : std::vector<Setting>{{"stroke.warp", "6"},
                                                      {"stroke.warp_scale", "40"},
                                                      {"fields.tone_local", "0.9"},
                                                      {"fields.gradient_tone", "0.9"},
                                                      {"width.trunk", "12"},
                                                      {stage + "down", "8"},
                                                      {stage + "carry", "0"},
                                                      {"root.place", "bottom"}})
        EXPECT_NE(picture_of(GetParam(), {change}), before) << change.key;
    const std::vector<Setting> local{{"fields.tone_local", "0.5"}};
    EXPECT_NE(picture_of(GetParam(), {local[0], {"fields.tone_local_scale", "30"}}), picture_of(GetParam(), local));
}

TEST_P(LightStyles, GrowDownwards) {
    const Drawing d = stylize(test::scene(kScene), load_style(GetParam(), {{"lattice.detail", "200"}}), {});
    double fall = 0, run = 0;
    for (std::uint32_t v = 0; v < d.dendrite.size(); ++v) {
        if (d.dendrite.is_root(v)) continue;
        const Vec2f step = d.dendrite.position_lattice[v] - d.dendrite.position_lattice[d.dendrite.parent[v]];
        fall += double(step.y);
        run += double(length(step));
    }
    EXPECT_GT(fall / run, 0.1);
}

TEST_P(LightStyles, VectorFilesHoldTheLight) {
    const Drawing d = stylize(test::scene(kScene), load_style(GetParam(), {{"lattice.detail", "200"}}), {});
    DisplayList vectors = with_lit_ground(d.list, 4096, {});
    ASSERT_TRUE(vectors.paper.picture);
    EXPECT_EQ(vectors.paper.picture->extent(), kScene);
    // Painted as vector formats paint it: strokes in their colours, here over instead of screened.
    for (Layer& layer : vectors.layers) layer.glow.reset();
    const Picture flat = raster(vectors, {kScene}, {}), wanted = raster(d.list, {kScene}, {});
    double difference = 0;
    for (std::size_t n = 0; n < flat.size(); ++n) difference += std::abs(int(flat[n].g) - int(wanted[n].g));
    EXPECT_LT(difference / double(flat.size()), 12);
}

TEST(Storm, TheTransparentPartsOfThePictureStayTransparent) {
    Picture scene = test::scene(kScene);
    for (int j = 0; j < kScene.y; ++j)
        for (int i = 0; i < 40; ++i) scene(i, j).a = 0;
    const Drawing d = stylize(scene, load_style("storm", {{"lattice.detail", "160"}}), {});
    const Picture out = raster(d.list, {kScene}, {});
    EXPECT_LT(out(3, 117).a, 40);
    EXPECT_EQ(out(120, 60).a, 255);
}

}  // namespace
}  // namespace dstylize
