// What a drawing in a scene owes to the drawing and to the ground: the same strokes, a ground that shadow only
// darkens, colours that stay where nothing is to be matched, a foot behind the ground, one answer.
#include <gtest/gtest.h>

#include <cmath>

#include "core/noise.h"
#include "imaging/filters.h"
#include "pipeline/scene.h"
#include "pipeline/scene_ground.h"
#include "pipeline/style_file.h"
#include "pipeline/stylize.h"
#include "render/raster.h"
#include "support/quick_style.h"
#include "support/scenes.h"

namespace dstylize {
namespace {

constexpr Extent kPortrait{120, 160}, kLand{320, 240};
constexpr Box kBox{{60, 20}, {150, 180}};

/// Of many colours, so that no pixel is like its neighbours by chance.
Picture land() {
    Picture out(kLand);
    const Noise noise(5, Purpose::jitter);
    for (std::size_t n = 0; n < out.size(); ++n) {
        const std::uint32_t bits = noise.bits(n);
        out[n] = {std::uint8_t(40 + bits % 160), std::uint8_t(60 + (bits >> 8) % 160),
                  std::uint8_t(30 + (bits >> 16) % 160), 255};
    }
    return out;
}

Drawing drawing_of(const std::string& style) {
    return stylize(test::scene(kPortrait), test::quick_style(style, {{"lattice.detail", "160"}}), {});
}

/// Everything off: the drawing on the background as it is.
SceneParameters plain() {
    SceneParameters p;
    p.painted = p.match = p.contact = p.shadow = 0;
    p.stands = true;
    return p;
}

DisplayList in_land(const Drawing& drawing, const SceneParameters& p, const Work& work = {}) {
    return in_scene(drawing, land(), kBox, p, 7, work);
}

const std::vector<Vec2f>& points(const Item& item) {
    if (const auto* fill = std::get_if<Fill>(&item)) return fill->outline_px;
    return std::get<VariableStroke>(item).points_px;
}

Rgba colour(const Item& item) {
    return std::visit([](const auto& it) { return it.colour; }, item);
}

class SceneLaws : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Styles, SceneLaws, ::testing::Values("tree", "autumn", "vine"));

TEST_P(SceneLaws, ThePlacedDrawingIsTheSameStrokesScaled) {
    const Drawing drawing = drawing_of(GetParam());
    const DisplayList scene = in_land(drawing, plain());
    const Placement to = placement(drawing.list, feet(drawing), kBox, true);
    ASSERT_EQ(scene.layers.size(), drawing.list.layers.size());
    std::size_t strokes = 0;
    for (std::size_t l = 0; l < scene.layers.size(); ++l) {
        const std::vector<Item>&before = drawing.list.layers[l].items, &after = scene.layers[l].items;
        ASSERT_EQ(after.size(), before.size());
        for (std::size_t i = 0; i < after.size(); ++i) {
            ASSERT_EQ(points(after[i]).size(), points(before[i]).size());
            for (std::size_t k = 0; k < points(after[i]).size(); ++k) {
                const Vec2f p = points(before[i])[k];
                ASSERT_NEAR(points(after[i])[k].x, p.x * to.scale + to.shift_px.x, 1e-3);
                ASSERT_NEAR(points(after[i])[k].y, p.y * to.scale + to.shift_px.y, 1e-3);
            }
            const auto *a = std::get_if<VariableStroke>(&before[i]), *b = std::get_if<VariableStroke>(&after[i]);
            ASSERT_EQ(a == nullptr, b == nullptr);
            if (!a) continue;
            ++strokes;
            for (std::size_t k = 0; k < a->width_px.size(); ++k)
                ASSERT_NEAR(b->width_px[k], a->width_px[k] * to.scale, 1e-4);
            ASSERT_TRUE(b->order == a->order && b->stage == a->stage && b->layer == a->layer);
        }
    }
    EXPECT_GT(strokes, 50u);
}

/// Of all items but those that are of the ground.
std::vector<Rgba> own_colours(const DisplayList& list) {
    std::vector<Rgba> out;
    for (const Layer& layer : list.layers)
        if (!layer.of_ground)
            for (const Item& item : layer.items) out.push_back(colour(item));
    return out;
}

TEST_P(SceneLaws, MatchingNothingChangesNoColour) {
    const Drawing drawing = drawing_of(GetParam());
    SceneParameters p = plain();
    const std::vector<Rgba> before = own_colours(drawing.list), as_it_was = own_colours(in_land(drawing, p));
    p.match = 1;
    const std::vector<Rgba> matched = own_colours(in_land(drawing, p));
    ASSERT_EQ(as_it_was, before);
    std::size_t moved = 0;
    for (std::size_t i = 0; i < before.size(); ++i) moved += !(matched[i] == before[i]);
    EXPECT_GT(moved, 50u) << "and matching does change them";
}

TEST_P(SceneLaws, BacklightOnlyDarkens) {
    const Drawing drawing = drawing_of(GetParam());
    SceneParameters p = plain();
    const std::vector<Rgba> before = own_colours(in_land(drawing, p));
    p.backlight = 1;
    const std::vector<Rgba> after = own_colours(in_land(drawing, p));
    std::size_t darker = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        ASSERT_LE(luma(after[i]), luma(before[i]));
        darker += luma(after[i]) < 0.8f * luma(before[i]);
    }
    EXPECT_GT(darker, 50u);
}

TEST_P(SceneLaws, AnyNumberOfThreadsGivesTheSameScene) {
    const Drawing drawing = drawing_of(GetParam());
    SceneParameters p;
    p.stands = true;
    const auto drawn = [&](int threads) {
        Work work;
        work.threads = threads;
        return raster(in_land(drawing, p, work), {kLand}, work);
    };
    const Picture one = drawn(1);
    EXPECT_TRUE(one == drawn(3));
    EXPECT_FALSE(one == land());
}

TEST(FadeLight, FallsToNothingAtTheEdgesInsideTheGroundAlone) {
    // A drawing of 100 x 100 in the top left corner of a ground of 400 x 400.
    DisplayList list{400, 400, {}, {}};
    VariableStroke across;
    for (const float x : {0.0f, 50.0f, 85.0f, 100.0f}) across.points_px.push_back({x, 40});
    across.width_px.assign(4, 2);
    list.layers = {{"light", Blend::max, {across}, Glow{}}, {"paint", Blend::over, {across}}};
    fade_light(list, {100, 100}, {1, {0, 0}}, 0.3f);
    const auto& lit = std::get<VariableStroke>(list.layers[0].items[0]).emission;
    ASSERT_EQ(lit.size(), 4u);
    EXPECT_EQ(lit[0], 1) << "the ground's own edge";
    EXPECT_EQ(lit[1], 1);
    EXPECT_NEAR(lit[2], 0.5f, 1e-5);
    EXPECT_EQ(lit[3], 0);
    EXPECT_TRUE(std::get<VariableStroke>(list.layers[1].items[0]).emission.empty());
}

TEST(Moved, LightAndReliefScaleWithTheStrokes) {
    DisplayList list{120, 80, {}, {}};
    Glow glow;
    glow.halos = {{0.01f, {}, 1}, {0.04f, {}, 1}};
    list.layers = {{"light", Blend::max, {}, glow}, {"body", Blend::max, {}, std::nullopt, Relief{}}};
    const DisplayList to = moved(list, {2.5f, {10, 5}}, {400, 600});
    const float was_px = 120, is_px = 600;  // long sides
    for (std::size_t h = 0; h < 2; ++h)
        EXPECT_NEAR(to.layers[0].glow->halos[h].sigma * is_px, 2.5f * glow.halos[h].sigma * was_px, 1e-3);
    EXPECT_NEAR(to.layers[0].glow->cast_sigma * is_px, 2.5f * glow.cast_sigma * was_px, 1e-3);
    const Relief before, after = *to.layers[1].relief;
    for (float Relief::*length :
         {&Relief::tip_length_px, &Relief::radius_px, &Relief::gap_sigma_px, &Relief::shadow_length_px,
          &Relief::shadow_sigma_px, &Relief::contact_sigma_px, &Relief::drape_sigma_px})
        EXPECT_FLOAT_EQ(after.*length, 2.5f * before.*length);
    EXPECT_EQ(after.height, before.height);
}

TEST(SceneGround, ShadowAndContactOnlyDarken) {
    const Drawing drawing = drawing_of("tree");
    const Picture ground = land();
    const auto shaded = [&](float contact, float shadow, float shadow_y) {
        SceneParameters p = plain();
        p.contact = contact;
        p.shadow = shadow;
        p.shadow_y = shadow_y;
        return *in_land(drawing, p).paper.picture;
    };
    EXPECT_TRUE(shaded(0, 0, 0.14f) == ground);
    for (const auto& [contact, shadow, y] :
         {std::array{1.0f, 0.0f, 0.14f}, {0.0f, 1.0f, 0.14f}, {0.0f, 1.0f, -0.3f}, {1.0f, 1.0f, 0.0f}}) {
        const Picture out = shaded(contact, shadow, y);
        std::size_t darker = 0;
        for (std::size_t n = 0; n < out.size(); ++n) {
            const Rgba8 a = out[n], b = ground[n];
            ASSERT_TRUE(a.r <= b.r && a.g <= b.g && a.b <= b.b && a.a == b.a) << n;
            darker += a.g + 4 < b.g;
        }
        EXPECT_GT(darker, 15u) << contact << " " << shadow << " " << y;
        EXPECT_LT(darker, out.size() / 2);
    }
}

TEST(SceneGround, BelowItsFeetTheGroundCoversTheDrawing) {
    Drawing drawing = drawing_of("tree");
    const float w = drawing.list.width_px, h = drawing.list.height_px;
    drawing.list.layers = {{"everywhere", Blend::over, {Fill{{{0, 0}, {w, 0}, {w, h}, {0, h}}, {1, 0, 0, 1}}}}};
    // Wide feet away from the picture's edge, so that there is ground below.
    for (std::uint32_t v = 0; v < drawing.dendrite.size(); ++v)
        if (drawing.dendrite.is_root(v)) drawing.dendrite.position_lattice[v].y -= 30, drawing.width_u[v] = 150;
    for (const float blades : {0.0f, 1.0f}) {
        SceneParameters p = plain();
        p.shadow = 0.5f;
        p.foreground = blades;
        const DisplayList scene = in_land(drawing, p);
        const Picture out = raster(scene, {kLand}, {});
        const Placement to = placement(drawing.list, feet(drawing), kBox, true);
        const float level = to.placed(feet(drawing)[0].at_px).y;
        ASSERT_LT(level + 10, to.placed({0, h}).y) << "the drawing reaches below its feet";
        const int middle = int(to.placed({w / 2, 0}).x), foot = int(to.placed(feet(drawing)[0].at_px).x);
        std::size_t hidden = 0, above = 0;
        for (int y = 0; y < kLand.y; ++y)
            for (int x = 0; x < kLand.x; ++x)
                if (float(y) > level) {
                    ASSERT_TRUE(out(x, y) == (*scene.paper.picture)(x, y)) << x << "," << y;
                    ++hidden;
                } else if (float(y) + 1 < level && std::abs(x - foot) < 3) {
                    above += out(x, y) == (*scene.paper.picture)(x, y) && y > int(level) - 20;
                }
        EXPECT_GT(hidden, 1000u);
        EXPECT_EQ(above > 0, blades > 0) << "blades rise before the foot";
        EXPECT_TRUE(out(middle, int(level) - 40) == (Rgba8{255, 0, 0, 255}));
    }
}

}  // namespace
}  // namespace dstylize
