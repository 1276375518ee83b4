#include <cmath>
#include <limits>
#include <string>

#include "unit/formats/codec_fixture.h"

namespace dstylize::test {
namespace {

using namespace std::string_literals;
using CodecSamples = CodecTest;
using Pixels = std::vector<Rgba8>;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST_F(CodecSamples, PngOfEveryKind) {
    EXPECT_EQ(pixels(decoded(png_file({3, 1, 8, 0}, "\0\x80\xff"s))),
              (Pixels{{0, 0, 0}, {128, 128, 128}, {255, 255, 255}}));
    EXPECT_EQ(pixels(decoded(png_file({4, 1, 1, 0}, "\xa0"s))), (Pixels{{255, 255, 255}, {}, {255, 255, 255}, {}}));
    EXPECT_EQ(pixels(decoded(png_file({2, 1, 8, 4}, "\x40\xff\x50\x07"s))),
              (Pixels{{64, 64, 64, 255}, {80, 80, 80, 7}}));
    EXPECT_EQ(pixels(decoded(png_file({1, 1, 8, 6}, "\xc8\x64\x32\x0a"s))), (Pixels{{200, 100, 50, 10}}));
    const std::string palette = png_chunk("PLTE", "\x01\x02\x03\xc8\x64\x32"s);
    const DecodedPicture opaque = decoded(png_file({2, 1, 8, 3}, "\1\0"s, palette));
    EXPECT_EQ(pixels(opaque), (Pixels{{200, 100, 50}, {1, 2, 3}}));
    EXPECT_FALSE(opaque.has_alpha);
    const DecodedPicture transparent = decoded(png_file({2, 1, 8, 3}, "\1\0"s, palette + png_chunk("tRNS", "\x09"s)));
    EXPECT_EQ(pixels(transparent), (Pixels{{200, 100, 50}, {1, 2, 3, 9}}));
    EXPECT_TRUE(transparent.has_alpha);
}

TEST_F(CodecSamples, SixteenBitsAreRounded) {
    EXPECT_EQ(pixels(decoded(png_file({1, 1, 16, 2}, "\x80\x80\x00\x7f\xff\xff"s))), (Pixels{{128, 0, 255}}));
    EXPECT_EQ(pixels(decoded(png_file({1, 1, 16, 2}, "\x00\x81\x12\x34\xab\xcd"s))), (Pixels{{1, 18, 171}}));
}

TEST_F(CodecSamples, PngGammaIsConverted) {
    // Linear light, gAMA 1.0.
    const FileBytes linear = png_file({2, 1, 8, 0}, "\x37\xff"s, png_chunk("gAMA", be(100'000, 4)));
    EXPECT_LE(difference(decoded(linear).picture[0], {srgb(0x37 / 255.0), srgb(0x37 / 255.0), srgb(0x37 / 255.0)}), 1);
    // 1 / 2.2 is what many programs call sRGB.
    EXPECT_EQ(decoded(png_file({1, 1, 8, 0}, "\x37"s, png_chunk("gAMA", be(45'455, 4)))).picture[0],
              (Rgba8{55, 55, 55}));
}

TEST_F(CodecSamples, PortableAnymaps) {
    EXPECT_EQ(pixels(decoded(file_of("P1\n# a comment\n2 1\n1 0\n"))), (Pixels{{}, {255, 255, 255}}));
    EXPECT_EQ(pixels(decoded(file_of("P2 2 1 15\n0 15\n"))), (Pixels{{}, {255, 255, 255}}));
    EXPECT_EQ(pixels(decoded(file_of("P3\n1 1\n255\n200 100 50\n"))), (Pixels{{200, 100, 50}}));
    EXPECT_EQ(pixels(decoded(file_of("P4\n3 1\n\xa0"s))), (Pixels{{}, {255, 255, 255}, {}}));
    EXPECT_EQ(pixels(decoded(file_of("P5\n2 1\n255\n\x07\xff"s))), (Pixels{{7, 7, 7}, {255, 255, 255}}));
    EXPECT_EQ(pixels(decoded(file_of("P6\n1 1\n65535\n\xff\xff\x80\x80\x00\x00"s))), (Pixels{{255, 128, 0}}));
    EXPECT_EQ(pixels(decoded(file_of("PF\n1 1\n-1.0\n" + float_le(1) + float_le(0.25f) + float_le(0)))),
              (Pixels{{255, srgb(0.25), 0}}));
}

TEST_F(CodecSamples, JpegOfInks) {
    for (const bool adobe : {false, true}) {
        const auto stored = [&](int ink) { return adobe ? 255 - ink : ink; };
        const FileBytes file = cmyk_jpeg_file({{stored(0), stored(255), stored(0), stored(0)},
                                               {stored(55), stored(0), stored(255), stored(0)},
                                               {stored(0), stored(0), stored(0), stored(204)}},
                                              adobe);
        const Picture picture = decoded(file).picture;
        ASSERT_EQ(picture.extent(), (Extent{24, 8}));
        EXPECT_EQ(picture(0, 7), (Rgba8{255, 0, 255})) << adobe;
        EXPECT_EQ(picture(9, 4), (Rgba8{200, 255, 0})) << adobe;
        EXPECT_EQ(picture(23, 0), (Rgba8{51, 51, 51})) << adobe;
    }
}

TEST_F(CodecSamples, BitmapsByTheirMasks) {
    const std::string row = "\x01\x02\x03\x00\x04\x05\x06\x00"s;  // blue, green, red, nothing
    const DecodedPicture plain = decoded(bmp_file(2, 1, {}, row));
    EXPECT_EQ(pixels(plain), (Pixels{{3, 2, 1}, {6, 5, 4}}));
    EXPECT_FALSE(plain.has_alpha);
    EXPECT_EQ(plain.metadata.dpi, 300);
    const std::vector<std::uint32_t> masks = {0xff, 0xff00, 0xff0000, 0xff000000};
    EXPECT_EQ(pixels(decoded(bmp_file(2, 1, masks, "\x01\x02\x03\x09\x04\x05\x06\xff"s))),
              (Pixels{{1, 2, 3, 9}, {4, 5, 6, 255}}));
    // An alpha of 0 everywhere is one that was never written.
    EXPECT_EQ(pixels(decoded(bmp_file(2, 1, masks, row))), (Pixels{{1, 2, 3}, {4, 5, 6}}));
    // Rows go upwards, unless the height is negative.
    EXPECT_EQ(decoded(bmp_file(1, 2, {}, row)).picture(0, 0), (Rgba8{6, 5, 4}));
    EXPECT_EQ(decoded(bmp_file(1, -2, {}, row)).picture(0, 0), (Rgba8{3, 2, 1}));
}

TEST_F(CodecSamples, GifPaletteAndTransparency) {
    const Pixels palette = {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {9, 8, 7}};
    const DecodedPicture opaque = decoded(gif_file(2, 2, palette, {3, 1, 2, 0}, -1));
    EXPECT_EQ(pixels(opaque), (Pixels{{9, 8, 7}, {0, 255, 0}, {0, 0, 255}, {255, 0, 0}}));
    EXPECT_FALSE(opaque.has_alpha);
    const DecodedPicture transparent = decoded(gif_file(2, 2, palette, {3, 1, 2, 0}, 1));
    EXPECT_EQ(transparent.picture(1, 0).a, 0);
    EXPECT_EQ(transparent.picture(0, 0), (Rgba8{9, 8, 7}));
    EXPECT_TRUE(transparent.has_alpha);
}

TEST_F(CodecSamples, TiffAlphaIsMadeStraight) {
    const std::string samples = "\x64\x32\x19\x80"s;  // 100 50 25, alpha 128
    EXPECT_EQ(pixels(decoded(tiff_file({1, 1, 4, 8, 2, 1, 1}, samples))), (Pixels{{199, 100, 50, 128}}));
    EXPECT_EQ(pixels(decoded(tiff_file({1, 1, 4, 8, 2, 1, 2}, samples))), (Pixels{{100, 50, 25, 128}}));
    const DecodedPicture unspecified = decoded(tiff_file({1, 1, 4, 8, 2, 1, 0}, samples));
    EXPECT_EQ(pixels(unspecified), (Pixels{{100, 50, 25}}));
    EXPECT_FALSE(unspecified.has_alpha);
}

TEST_F(CodecSamples, TiffGreyEitherWay) {
    EXPECT_EQ(pixels(decoded(tiff_file({2, 1, 1, 8, 1}, "\x00\xf0"s))), (Pixels{{}, {240, 240, 240}}));
    EXPECT_EQ(pixels(decoded(tiff_file({2, 1, 1, 8, 0}, "\x00\xf0"s))), (Pixels{{255, 255, 255}, {15, 15, 15}}));
    EXPECT_EQ(pixels(decoded(tiff_file({2, 1, 1, 16, 0}, "\x00\x00\xff\xff"s))), (Pixels{{255, 255, 255}, {}}));
    EXPECT_EQ(pixels(decoded(tiff_file({4, 1, 1, 1, 0}, "\x50"s))), (Pixels{{255, 255, 255}, {}, {255, 255, 255}, {}}));
}

TEST_F(CodecSamples, TiffPaletteWithAlpha) {
    std::vector<int> map(768, 0);
    map[5] = 200 * 257, map[256 + 5] = 100 * 257, map[512 + 5] = 50 * 257;
    EXPECT_EQ(pixels(decoded(tiff_file({1, 1, 2, 8, 3, 1, 2}, "\x05\x40"s, {tiff_short(320, map)}))),
              (Pixels{{200, 100, 50, 64}}));
    EXPECT_EQ(pixels(decoded(tiff_file({1, 1, 1, 8, 3}, "\x05"s, {tiff_short(320, map)}))), (Pixels{{200, 100, 50}}));
}

TEST_F(CodecSamples, TiffInksWithoutAProfile) {
    const Pixels expected = {{255, 255, 255}, {}, {127, 255, 255}};
    EXPECT_EQ(pixels(decoded(tiff_file({3, 1, 4, 8, 5}, "\0\0\0\0\0\0\0\xff\x80\0\0\0"s))), expected);
}

TEST_F(CodecSamples, TiffLab) {
    // CIE L*a*b* (50, 0, 0) is a middle grey of 119, (54.3, 80.8, 69.9) about pure red.
    const DecodedPicture lab = decoded(tiff_file({2, 1, 3, 8, 8}, "\x80\x00\x00\x8b\x51\x46"s));
    EXPECT_LE(difference(lab.picture[0], {119, 119, 119}), 2);
    EXPECT_LE(difference(lab.picture[1], {255, 0, 0}), 6);
}

TEST_F(CodecSamples, FloatsAreLinearAndClamped) {
    std::string samples;
    for (const float v : {0.0f, 0.5f, 1.0f, -3.0f, 7.0f, kInfinity, -kInfinity, kNan, 0.002f}) samples += float_le(v);
    EXPECT_EQ(pixels(decoded(tiff_file({3, 1, 3, 32, 2, 3}, samples))),
              (Pixels{{0, srgb(0.5), 255}, {0, 255, 255}, {0, 0, srgb(0.002)}}));
}

TEST_F(CodecSamples, EveryFloatCodeIsRoundedExactly) {
    // The middle of each code's interval, and just beside its ends.
    std::string samples;
    Pixels expected;
    const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
    for (int code = 1; code < 255; ++code)
        for (const double offset : {-0.499, 0.0, 0.499}) {
            samples += float_le(float(linear((code + offset) / 255)));
            const auto c = std::uint8_t(code);
            expected.push_back({c, c, c});
        }
    EXPECT_EQ(pixels(decoded(tiff_file({int(expected.size()), 1, 1, 32, 1, 3}, samples))), expected);
}

TEST_F(CodecSamples, OpenExr) {
    ExrKind kind;
    kind.data[2] = kind.display[2] = 1;
    kind.channels = {"A", "B", "G", "R"};
    // Associated alpha: half of everything; a transparent pixel; NaN and infinity.
    const std::vector<float> row = {0.5f, 0, 0.05f, kNan, 0.25f, kNan, 0.5f, kInfinity};
    const DecodedPicture exr = decoded(exr_file(kind, row));
    EXPECT_TRUE(exr.has_alpha);
    EXPECT_EQ(exr.picture[0], (Rgba8{255, srgb(0.5), srgb(0.1), 128}));
    EXPECT_EQ(exr.picture[1].a, 0);
    kind.channels = {"Y"};
    EXPECT_EQ(pixels(decoded(exr_file(kind, {0.5f, kInfinity}))), (Pixels{{188, 188, 188}, {255, 255, 255}}));
    kind.channels = {"beauty.B", "beauty.G", "beauty.R", "depth.Z"};
    EXPECT_EQ(pixels(decoded(exr_file(kind, {0, 1, 0, 1, 1, 0, 9, 9}))), (Pixels{{255, 0, 0}, {0, 255, 255}}));
}

TEST_F(CodecSamples, OpenExrShowsItsDisplayWindow) {
    ExrKind kind;
    kind.channels = {"Y"};
    kind.data[0] = 1, kind.data[1] = 0, kind.data[2] = 3, kind.data[3] = 0;
    kind.display[2] = 2, kind.display[3] = 1;
    const DecodedPicture part = decoded(exr_file(kind, {0, 1, 0}));
    EXPECT_EQ(part.picture.extent(), (Extent{3, 2}));
    EXPECT_EQ(part.picture(0, 0).a, 0);
    EXPECT_EQ(part.picture(1, 0), (Rgba8{0, 0, 0, 255}));
    EXPECT_EQ(part.picture(2, 0), (Rgba8{255, 255, 255, 255}));
    EXPECT_EQ(part.picture(1, 1).a, 0);
    EXPECT_TRUE(part.has_alpha);
}

TEST_F(CodecSamples, RadianceHdr) {
    // 128 * 2^(129 - 136) = 1; 64 is half of it.
    EXPECT_EQ(pixels(decoded(hdr_file(2, 1, "\x80\x40\x00\x81\x00\x00\x00\x00"s))), (Pixels{{255, srgb(0.5), 0}, {}}));
}

}  // namespace
}  // namespace dstylize::test
