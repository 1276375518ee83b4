#include "importance/fields.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/noise.h"
#include "core/vec.h"
#include "imaging/filters.h"
#include "importance/frame.h"
#include "support/scenes.h"

namespace dstylize {
namespace {

Fields fields_of(const Picture& picture, Extent lattice, FieldParameters p = {}, UserMaps maps = {}) {
    return Fields(resized(luma_plane(picture), lattice), p, std::move(maps), 1);
}

double correlation(const Grid<float>& a, const Grid<float>& b) {
    double ma = 0, mb = 0, ab = 0, aa = 0, bb = 0;
    for (std::size_t n = 0; n < a.size(); ++n) ma += a[n], mb += b[n];
    ma /= double(a.size()), mb /= double(b.size());
    for (std::size_t n = 0; n < a.size(); ++n)
        ab += (a[n] - ma) * (b[n] - mb), aa += (a[n] - ma) * (a[n] - ma), bb += (b[n] - mb) * (b[n] - mb);
    return ab / std::sqrt(aa * bb);
}

TEST(Fields, EveryFieldLiesInTheUnitRange) {
    Fields fields = fields_of(test::scene({200, 150}), {256, 192});
    for (const std::string_view name : Fields::names()) {
        const Grid<float>& f = fields[name];
        ASSERT_EQ(f.extent(), (Extent{256, 192})) << name;
        for (const float v : f) ASSERT_TRUE(v >= 0 && v <= 1) << name << " " << v;
    }
}

TEST(Fields, LocalToneDarkensWideBrightAreasAndKeepsSmallOnes) {
    Picture picture = test::flat({200, 150}, {20, 20, 20, 255});
    for (int j = 0; j < 150; ++j)
        for (int i = 0; i < 200; ++i)
            if (i < 100 || (std::abs(i - 170) < 6 && std::abs(j - 75) < 6)) picture(i, j) = {240, 240, 240, 255};
    FieldParameters p;
    p.bright = true;
    p.tone_equalise = 0;
    Fields plain = fields_of(picture, {256, 192}, p);
    p.tone_local = 0.5f;
    Fields local = fields_of(picture, {256, 192}, p);
    const auto at = [](Fields& f, int x, int y) { return f["tone"](x * 256 / 200, y * 192 / 150); };
    EXPECT_NEAR(at(plain, 20, 75), at(plain, 170, 75), 0.02);
    EXPECT_LT(at(local, 20, 75), at(local, 170, 75) - 0.1f);
}

TEST(Fields, ToneGatesTheGradient) {
    FieldParameters p;
    Fields plain = fields_of(test::scene({200, 150}), {256, 192}, p);
    p.gradient_tone = 1;
    Fields gated = fields_of(test::scene({200, 150}), {256, 192}, p);
    const Grid<float>& tone = gated["tone"];
    float least_gated = 1, most_plain = 0;
    for (std::size_t n = 0; n < tone.size(); ++n)
        if (tone[n] < 0.02f && plain["gradient"][n] > most_plain) {
            most_plain = plain["gradient"][n];
            least_gated = gated["gradient"][n];
        }
    EXPECT_LT(least_gated, 0.7f * most_plain);
}

TEST(Fields, LowFeaturesAreTheFeaturesBelow) {
    Fields fields = fields_of(test::scene({200, 150}), {256, 192});
    const Grid<float>&low = fields["low_features"], &all = fields["features"];
    for (int i = 0; i < 256; ++i) {
        ASSERT_EQ(low(i, 20), 0) << i;
        ASSERT_FLOAT_EQ(low(i, 170), all(i, 170)) << i;
    }
}

TEST(Fields, FlatPicturesHaveNoGradientAndNoNotANumber) {
    for (const std::uint8_t level : {0, 128, 255}) {
        Fields fields = fields_of(test::flat({40, 30}, {level, level, level, 255}), {64, 48});
        for (const float v : fields["gradient"]) ASSERT_EQ(v, 0);
        for (const std::string_view name : Fields::names())
            for (const float v : fields[name]) ASSERT_TRUE(std::isfinite(v)) << name;
    }
}

TEST(Fields, ImportanceIsThreePartsGradientAndOnePartDarkness) {
    FieldParameters p;
    p.tone_equalise = 0, p.tone_white = 0, p.tone_black = 1, p.importance_lines = 0, p.importance_percentile = 100;
    p.border_width = 1;
    Fields fields = fields_of(test::scene({200, 150}), {200, 150}, p);
    const Grid<float>&g = fields["gradient"], &d = fields["darkness"], &i = fields["importance"];
    for (int y = 20; y < 130; ++y)
        for (int x = 20; x < 180; ++x) ASSERT_NEAR(i(x, y), (3 * g(x, y) + d(x, y)) / 4, 1e-5f);
}

TEST(Fields, NoiseIsKeyedByPicturePosition) {
    const Picture picture = test::scene({512, 384});
    Fields coarse = fields_of(picture, {512, 384}), fine = fields_of(picture, {1024, 768});
    const Grid<float> halved = resized(fine["smooth_noise"], {512, 384});
    EXPECT_GT(correlation(coarse["smooth_noise"], halved), 0.95);
}

TEST(Fields, WhatIsForgottenComesAgainAsItWas) {
    Fields fields = fields_of(test::scene({120, 90}), {128, 96});
    const Grid<float> tone = fields["tone"], importance = fields["importance"], noise = fields["white_noise"];
    constexpr std::string_view kNames[] = {"tone", "gradient", "importance", "white_noise"};
    fields.release(kNames);
    EXPECT_TRUE(fields["importance"] == importance && fields["tone"] == tone && fields["white_noise"] == noise);
}

TEST(Fields, WhiteNoiseIsOneNumberPerCellWhereNodesAreFiner) {
    const Noise expected(1, Purpose::white_noise);
    for (const int side : {40, 3000}) {  // cells are half a u, the picture's long side 1024 u
        Fields fields = fields_of(test::scene({32, 32}), {side, 30});
        const auto cell = [&](int node) { return std::uint64_t((float(node) + 0.5f) * (2 / fields.u())); };
        for (int j = 0; j < 30; ++j)
            for (int i = 0; i < side; ++i)
                ASSERT_EQ(fields["white_noise"](i, j), expected.unit(cell(j) << 32 | cell(i))) << i << " " << j;
    }
}

TEST(Fields, BorderFallsWithTheDistanceFromTheFrame) {
    for (const Extent e : {Extent{200, 120}, Extent{300, 7}, Extent{1, 1}}) {
        Fields fields = fields_of(test::scene({50, 30}), e);
        const float inner = 3 * fields.u(), outer = std::max(24 * fields.u(), inner + 1);
        for (int j = 0; j < e.y; ++j)
            for (int i = 0; i < e.x; ++i) {
                const float away = float(std::min({i, e.x - 1 - i, j, e.y - 1 - j}));
                ASSERT_FLOAT_EQ(fields["border"](i, j), 1 - smoothstep(inner, outer, away)) << i << " " << j;
            }
    }
}

TEST(Fields, WhiteNoiseIsUniform) {
    Fields fields = fields_of(test::scene({64, 64}), {512, 512});
    double sum = 0, squares = 0;
    for (const float v : fields["white_noise"]) sum += v, squares += double(v) * v;
    const double n = 512 * 512;
    EXPECT_NEAR(sum / n, 0.5, 0.005);
    EXPECT_NEAR(squares / n - (sum / n) * (sum / n), 1.0 / 12, 0.002);
}

TEST(Fields, FlowRunsAlongStripes) {
    Picture stripes({256, 256});
    for (int j = 0; j < 256; ++j)
        for (int i = 0; i < 256; ++i) {
            const auto v = std::uint8_t(127 + 120 * std::sin(0.2 * (i + j)));  // lines along (1, -1)
            stripes(i, j) = {v, v, v, 255};
        }
    Fields fields = fields_of(stripes, {256, 256});
    const Vec2f along = normalized(Vec2f{1, -1});
    for (int y = 40; y < 216; y += 8)
        for (int x = 40; x < 216; x += 8) {
            const Vec2f f = fields.flow()(x, y);
            ASSERT_GT(length(f), 0.5f);
            ASSERT_GT(std::abs(dot(normalized(f), along)), 0.98f);
        }
}

TEST(Fields, UserMapsMultiplyOrReplace) {
    const Picture picture = test::scene({100, 80});
    const Extent e{128, 102};
    UserMaps zero{Grid<float>(e, 0.0f), false}, half{Grid<float>(e, 0.5f), true};
    Fields none = fields_of(picture, e, {}, zero), replaced = fields_of(picture, e, {}, half);
    for (const float v : none["importance"]) ASSERT_EQ(v, 0);
    for (const float v : replaced["importance"]) ASSERT_EQ(v, 0.5f);
}

TEST(Fields, UnknownNameIsAnError) {
    Fields fields = fields_of(test::scene({16, 16}), {16, 16});
    EXPECT_THROW(fields["importnace"], Error);
}

TEST(FlatFrame, IsFoundAndPaintedOver) {
    Picture picture = test::scene({300, 200});
    for (int j = 0; j < 200; ++j)
        for (int i = 0; i < 4; ++i) picture(i, j) = {90, 90, 90, 255};
    Grid<float> luma = luma_plane(picture);
    const Frame frame = flat_frame(luma);
    EXPECT_GE(frame.left, 4);
    EXPECT_LE(frame.left, 8);
    paint_over_frame(luma);
    for (int j = 10; j < 190; ++j) ASSERT_FLOAT_EQ(luma(0, j), luma(frame.left, j));
}

TEST(FlatFrame, AFlatBackgroundIsNoFrame) {
    EXPECT_EQ(flat_frame(luma_plane(test::flat({300, 200}, {255, 255, 255, 255}))), Frame{});
}

}  // namespace
}  // namespace dstylize
