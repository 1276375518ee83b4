#include "render/raster.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numbers>

#include "core/noise.h"
#include "geometry/stroke_outline.h"

namespace dstylize {
namespace {

constexpr Rgba kBlack{0, 0, 0, 1};

DisplayList sheet(float width, float height, Rgba paper = {1, 1, 1, 0}) { return {width, height, {paper, 0, 0}, {}}; }

VariableStroke straight(Vec2f a, Vec2f b, float width, Rgba colour = kBlack) {
    return {{a, b}, {width, width}, colour, 0, 0};
}

Fill box(float x0, float y0, float x1, float y1, Rgba colour = kBlack) {
    return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, colour};
}

Picture drawn(const DisplayList& list, int width, int height, int threads = 0) {
    Work work;
    work.threads = threads;
    return raster(list, {{width, height}}, work);
}

double mean_alpha(const Picture& p) {
    double sum = 0;
    for (const Rgba8 c : p) sum += c.a;
    return sum / 255 / double(p.size());
}

/// Curls, hairlines, thick trunks and a fill all over a sheet of 300 x 200.
DisplayList busy() {
    DisplayList list = sheet(300, 200, {0.96f, 0.94f, 0.88f, 1});
    const Noise noise(11, Purpose::jitter);
    std::uint64_t draw = 0;
    list.layers.push_back(
        {"leaves", Blend::over, {Fill{{{20, 30}, {90, 10}, {120, 60}, {60, 90}}, {0.5f, 0.7f, 0.4f, 0.8f}}}});
    Layer ink{"ink", Blend::max, {}};
    for (int s = 0; s < 150; ++s) {
        VariableStroke stroke;
        stroke.colour = {0.1f, 0.1f, 0.2f, 1};
        Vec2f at{300 * noise.unit(draw++), 200 * noise.unit(draw++)};
        float heading = 6.28f * noise.unit(draw++);
        const float bend = 0.5f * (noise.unit(draw++) - 0.5f), width = 0.4f + 5 * std::pow(noise.unit(draw++), 3.0f);
        for (int i = 0; i < 20; ++i) {
            stroke.points_px.push_back(at);
            stroke.width_px.push_back(width * (1 - float(i) / 22));
            at = at + Vec2f{2 * std::cos(heading), 2 * std::sin(heading)};
            heading += bend;
        }
        ink.items.push_back(std::move(stroke));
    }
    list.layers.push_back(std::move(ink));
    return list;
}

TEST(Raster, ThreadsDoNotChangeABit) {
    DisplayList list = busy();
    list.paper.grain = 0.03f;
    const Picture reference = drawn(list, 450, 300, 1);
    EXPECT_EQ(drawn(list, 450, 300, 2), reference);
    const tbb::global_control three(tbb::global_control::max_allowed_parallelism, 3);
    EXPECT_EQ(drawn(list, 450, 300), reference);
}

TEST(Raster, TilesCannotBeSeen) {
    // The same drawing, moved by whole pixels, falls differently into the tiles.
    const DisplayList list = busy();
    DisplayList moved = list;
    moved.width_px += 64, moved.height_px += 64;
    for (Layer& layer : moved.layers)
        for (Item& item : layer.items)
            std::visit(
                [](auto& it) {
                    if constexpr (requires { it.points_px; })
                        for (Vec2f& p : it.points_px) p = p + Vec2f{37, 23};
                    else
                        for (Vec2f& p : it.outline_px) p = p + Vec2f{37, 23};
                },
                item);
    const Picture a = drawn(list, 300, 200), b = drawn(moved, 364, 264);
    for (int y = 0; y < 200; ++y)
        for (int x = 0; x < 300; ++x) {
            ASSERT_NEAR(a(x, y).r, b(x + 37, y + 23).r, 2) << x << ' ' << y;
            ASSERT_NEAR(a(x, y).g, b(x + 37, y + 23).g, 2) << x << ' ' << y;
        }
}

TEST(Raster, HalfTheSizeIsTheMeanOfTheFull) {
    const DisplayList list = busy();
    for (const int half : {75, 150, 300, 900}) {
        const int height = half * 2 / 3;
        const Picture small = drawn(list, half, height), large = drawn(list, 2 * half, 2 * height);
        double worst = 0, squares = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < half; ++x) {
                const int sum = large(2 * x, 2 * y).r + large(2 * x + 1, 2 * y).r + large(2 * x, 2 * y + 1).r +
                                large(2 * x + 1, 2 * y + 1).r;
                const double off = std::abs(sum / 4.0 - small(x, y).r);
                worst = std::max(worst, off);
                squares += off * off;
            }
        EXPECT_LT(worst, 40) << half;  // single pixels in the crotch of two strokes
        EXPECT_LT(std::sqrt(squares / double(small.size())), 2) << half;
    }
}

TEST(Raster, DenseHairlinesKeepTheirToneAtAnySize) {
    DisplayList list = sheet(200, 200);
    Layer ink{"ink", Blend::max, {}};
    for (float x = -50; x < 250; x += 2) ink.items.push_back(straight({x, -5}, {x + 30, 205}, 0.5f));
    list.layers.push_back(std::move(ink));
    const double tone = 0.25 * std::hypot(30, 210) / 210;
    for (const int size : {50, 100, 200, 333, 800})
        EXPECT_NEAR(mean_alpha(drawn(list, size, size)) / tone, 1, 0.03) << size;
}

TEST(Raster, MagnifiedCurvesHaveNoFacets) {
    DisplayList list = sheet(100, 100);
    VariableStroke ring{{}, {}, kBlack, 0, 0};
    for (int i = 0; i <= 32; ++i) {
        const float angle = 2 * std::numbers::pi_v<float> * float(i) / 32;
        ring.points_px.push_back({50 + 40 * std::cos(angle), 50 + 40 * std::sin(angle)});
        ring.width_px.push_back(4);
    }
    list.layers.push_back({"ink", Blend::max, {ring}});
    const int scale = 8;
    const Picture p = drawn(list, 100 * scale, 100 * scale);
    for (int y = 0; y < 100 * scale; ++y)
        for (int x = 0; x < 88 * scale; ++x) {  // clear of the two ends
            const double r = std::hypot((x + 0.5) / scale - 50, (y + 0.5) / scale - 50);
            // A facet would be off by 0.19 of the list's pixels.
            if (r > 42.12 || r < 37.88) {
                ASSERT_EQ(p(x, y).a, 0) << x << ' ' << y;
            }
            if (r < 41.88 && r > 38.12) {
                ASSERT_EQ(p(x, y).a, 255) << x << ' ' << y;
            }
        }
}

TEST(Raster, MaxLayersShowNoOverlapsAndOverLayersDo) {
    const Rgba half{0, 0, 0, 0.5f};
    const std::vector<Item> cross{straight({10, 30}, {50, 30}, 10, half), straight({30, 10}, {30, 50}, 10, half)};
    DisplayList list = sheet(60, 60);
    list.layers = {{"ink", Blend::max, cross}};
    EXPECT_EQ(drawn(list, 60, 60)(30, 30), (Rgba8{0, 0, 0, 128}));
    EXPECT_EQ(drawn(list, 60, 60)(15, 30), (Rgba8{0, 0, 0, 128}));
    list.layers = {{"ink", Blend::over, cross}};
    EXPECT_EQ(drawn(list, 60, 60)(30, 30), (Rgba8{0, 0, 0, 191}));
    EXPECT_EQ(drawn(list, 60, 60)(15, 30), (Rgba8{0, 0, 0, 128}));
}

TEST(Raster, AStrokeOfAnOverLayerDoesNotOverlapItself) {
    DisplayList list = sheet(60, 60);
    list.layers = {{"ink",
                    Blend::over,
                    {VariableStroke{{{10, 10}, {50, 30}, {10, 50}, {50, 10}}, {8, 8, 8, 8}, {0, 0, 0, 0.5f}, 0, 0}}}};
    for (const Rgba8 c : drawn(list, 60, 60)) EXPECT_LE(c.a, 128);
}

TEST(Raster, InAMaxLayerTheMostCoverageWinsAndOfEqualOnesTheLater) {
    const Rgba red{1, 0, 0, 1}, blue{0, 0, 1, 1};
    DisplayList list = sheet(40, 40);
    list.layers = {{"ink", Blend::max, {straight({5, 20}, {35, 20}, 8, red), straight({20, 5}, {20, 35}, 8, blue)}}};
    EXPECT_EQ(drawn(list, 40, 40)(20, 20), (Rgba8{0, 0, 255, 255}));
    EXPECT_EQ(drawn(list, 40, 40)(8, 20), (Rgba8{255, 0, 0, 255}));
    // A hairline over a full stroke covers less of every sample and so does not show.
    list.layers[0].items[1] = straight({20, 5}, {20, 35}, 0.05f, blue);
    EXPECT_EQ(drawn(list, 40, 40)(20, 20), (Rgba8{255, 0, 0, 255}));
}

TEST(Raster, LayersLieOverOneAnother) {
    DisplayList list = sheet(30, 30, {1, 1, 1, 1});
    list.layers = {{"below", Blend::max, {box(0, 0, 30, 30, {1, 0, 0, 1})}},
                   {"above", Blend::max, {box(10, 0, 30, 30, {0, 0, 1, 0.5f})}}};
    const Picture p = drawn(list, 30, 30);
    EXPECT_EQ(p(5, 5), (Rgba8{255, 0, 0, 255}));
    EXPECT_EQ(p(20, 5), (Rgba8{128, 0, 128, 255}));
}

TEST(Raster, TransparentPaperKeepsTheInksColourAtSoftEdges) {
    DisplayList list = sheet(64, 64);
    list.layers = {{"ink", Blend::max, {straight({7, 9}, {55, 51}, 3.3f, {0.8f, 0.4f, 0.2f, 1})}}};
    int soft = 0;
    for (const Rgba8 c : drawn(list, 64, 64)) {
        if (c.a == 0) {
            EXPECT_EQ(c, (Rgba8{0, 0, 0, 0}));
        }
        if (c.a > 0) {
            EXPECT_EQ((Rgba8{c.r, c.g, c.b, 255}), (Rgba8{204, 102, 51, 255}));
        }
        soft += c.a > 0 && c.a < 255;
    }
    EXPECT_GT(soft, 50);
}

TEST(Raster, FillsCoverTheirExactArea) {
    DisplayList list = sheet(100, 100);
    list.layers = {{"fill", Blend::over, {Fill{{{10.3f, 12.1f}, {81.7f, 20.9f}, {60.2f, 88.8f}}, kBlack}}}};
    const double area = 0.5 * std::abs((81.7 - 10.3) * (88.8 - 12.1) - (60.2 - 10.3) * (20.9 - 12.1));
    EXPECT_NEAR(mean_alpha(drawn(list, 100, 100)) * 1e4, area, 0.002 * area);
    list.layers = {{"fill", Blend::over, {box(10.25f, 10, 20, 20.5f)}}};
    const Picture p = drawn(list, 100, 100);
    EXPECT_EQ(p(10, 15).a, 191);
    EXPECT_EQ(p(15, 20).a, 128);
    EXPECT_EQ(p(15, 15).a, 255);
    EXPECT_EQ(p(9, 15).a, 0);
}

TEST(Raster, FillsThatOverlapThemselvesAreSolid) {
    DisplayList list = sheet(50, 50);
    // A square walked around twice.
    list.layers = {{"fill",
                    Blend::over,
                    {Fill{{{5, 5}, {45, 5}, {45, 45}, {5, 45}, {5, 5}, {45, 5}, {45, 45}, {5, 45}}, kBlack}}}};
    EXPECT_EQ(drawn(list, 50, 50)(25, 25).a, 255);
    EXPECT_NEAR(mean_alpha(drawn(list, 50, 50)), 0.64, 1e-3);
}

TEST(Raster, StrokesEqualTheirFilledOutlines) {
    const DisplayList strokes = busy();
    DisplayList fills = strokes;
    for (Item& item : fills.layers[1].items) {
        const auto& stroke = std::get<VariableStroke>(item);
        item = Fill{stroke_outline(smooth_line(stroke.points_px, stroke.width_px, 0.01f), 0.005f), stroke.colour};
    }
    const Picture a = drawn(strokes, 1200, 800), b = drawn(fills, 1200, 800);
    double squares = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        ASSERT_NEAR(a[i].r, b[i].r, 20) << i % 1200 << ' ' << i / 1200;  // at the round ends
        squares += (a[i].r - b[i].r) * (a[i].r - b[i].r);
    }
    EXPECT_LT(std::sqrt(squares / double(a.size())), 1);
}

TEST(Raster, GrainHasMeanZeroAndTheDeviationAskedFor) {
    DisplayList list = sheet(512, 512, {0.5f, 0.5f, 0.5f, 1});
    list.paper.grain = 0.04f;
    list.paper.seed = 5;
    const Picture p = drawn(list, 512, 512);
    double sum = 0, squares = 0;
    for (const Rgba8 c : p) sum += c.r, squares += double(c.r) * c.r;
    const double mean = sum / double(p.size()), deviation = std::sqrt(squares / double(p.size()) - mean * mean);
    EXPECT_NEAR(mean, 127.5, 0.2);
    EXPECT_NEAR(deviation, 0.04 * 127.5, 0.25);
}

TEST(Raster, GrainBelongsToThePixelAndTheSeed) {
    DisplayList small = sheet(150, 100, {0.5f, 0.5f, 0.5f, 1}), large = sheet(300, 200, {0.5f, 0.5f, 0.5f, 1});
    small.paper.grain = large.paper.grain = 0.1f;
    // Strokes change the size of the tiles, not the grain beside them.
    large.layers = {{"ink", Blend::max, {straight({0, 199}, {300, 199}, 0.4f)}}};
    const Picture a = drawn(small, 150, 100), b = drawn(large, 300, 200);
    for (int y = 0; y < 100; ++y)
        for (int x = 0; x < 150; ++x) ASSERT_EQ(a(x, y), b(x, y)) << x << ' ' << y;
    small.paper.seed = 1;
    EXPECT_FALSE(drawn(small, 150, 100) == a);
}

TEST(Raster, TransparentPaperHasNoGrain) {
    DisplayList list = sheet(20, 20);
    list.paper.grain = 0.2f;
    for (const Rgba8 c : drawn(list, 20, 20)) EXPECT_EQ(c.a, 0);
}

TEST(Raster, AnythingMayLieOutsideOrBeEmpty) {
    DisplayList list = sheet(20, 20);
    list.layers = {{"ink",
                    Blend::max,
                    {straight({-1e6f, 5}, {1e6f, 5}, 2), straight({500, 500}, {900, 900}, 30), VariableStroke{},
                     VariableStroke{{{3, 15}}, {4}, kBlack, 0, 0}, Fill{}, Fill{{{1, 1}, {2, 2}}, kBlack},
                     box(-1e6f, 18, 1e6f, 1e6f)}},
                   {"empty", Blend::over, {}}};
    const Picture p = drawn(list, 20, 20);
    EXPECT_EQ(p(10, 4).a, 255);
    EXPECT_EQ(p(10, 7).a, 0);
    EXPECT_EQ(p(3, 15).a, 255);
    EXPECT_EQ(p(10, 19).a, 255);
    EXPECT_EQ(drawn(list, 1, 1).size(), 1u);
}

TEST(Raster, StopsWhenAsked) {
    std::stop_source source;
    source.request_stop();
    Work work;
    work.stop = source.get_token();
    try {
        raster(busy(), {{300, 200}}, work);
        FAIL() << "it went on";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::cancelled);
    }
}

}  // namespace
}  // namespace dstylize
