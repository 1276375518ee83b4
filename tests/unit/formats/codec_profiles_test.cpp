#include <string>

#include "unit/formats/codec_fixture.h"

namespace dstylize::test {
namespace {

using namespace std::string_literals;
using CodecProfiles = CodecTest;

std::string iccp_chunk(const std::string& profile) { return png_chunk("iCCP", "p\0\0"s + stored_zlib(profile)); }

/// What p3_profile() means, by the matrix from linear Display P3 to linear sRGB.
Rgba8 from_p3(Rgba8 c) {
    const double r = std::pow(c.r / 255.0, 2.2), g = std::pow(c.g / 255.0, 2.2), b = std::pow(c.b / 255.0, 2.2);
    return {srgb(1.2249 * r - 0.2247 * g), srgb(-0.0420 * r + 1.0419 * g), srgb(-0.0197 * r - 0.0786 * g + 1.0979 * b)};
}

Picture flat(Rgba8 colour) { return Picture({16, 16}, colour); }

TEST_F(CodecProfiles, WideGamutColoursAreConvertedInEveryFormat) {
    const Rgba8 stored{200, 100, 50}, expected = from_p3(stored);
    EncodeOptions options;
    const FileBytes png = png_with_chunks(png_file({1, 1, 8, 2}, "\xc8\x64\x32"s), iccp_chunk(p3_profile()));
    EXPECT_LE(difference(decoded(png).picture[0], expected), 2);

    options.format = "jpg";
    EXPECT_LE(difference(decoded(jpeg_with_profile(encoded(flat(stored), options), p3_profile())).picture[0], expected),
              3);

    options.format = "webp";
    options.quality = 100;
    EXPECT_LE(
        difference(decoded(webp_with_chunk(encoded(flat(stored), options), "ICCP", p3_profile())).picture[0], expected),
        2);

    const std::string profile = p3_profile();
    const TiffTagBytes tag{34675, 7, std::uint32_t(profile.size()), profile};
    EXPECT_LE(difference(decoded(tiff_file({1, 1, 3, 8}, "\xc8\x64\x32"s, {tag})).picture[0], expected), 2);
    EXPECT_LE(difference(decoded(tiff_file({1, 1, 3, 16}, "\xc8\xc8\x64\x64\x32\x32"s, {tag})).picture[0], expected),
              2);
}

TEST_F(CodecProfiles, AlphaIsLeftAlone) {
    const Rgba8 expected = from_p3({200, 100, 50});
    const FileBytes png = png_with_chunks(png_file({1, 1, 8, 6}, "\xc8\x64\x32\x29"s), iccp_chunk(p3_profile()));
    EXPECT_LE(difference(decoded(png).picture[0], {expected.r, expected.g, expected.b, 41}), 2);
}

TEST_F(CodecProfiles, GreyIsConverted) {
    const FileBytes png = png_with_chunks(png_file({1, 1, 8, 0}, "\x37"s), iccp_chunk(grey_profile(1)));
    EXPECT_LE(difference(decoded(png).picture[0], {srgb(55 / 255.0), srgb(55 / 255.0), srgb(55 / 255.0)}), 2);
}

TEST_F(CodecProfiles, InksLookAsTheirProfileSays) {
    // A "black" that is blue, where (1 - ink)(1 - black) would say black.
    const std::string profile = cmyk_profile({100, 0, 0}, {30, 20, -60});
    const TiffTagBytes tag{34675, 7, std::uint32_t(profile.size()), profile};
    const DecodedPicture inks = decoded(tiff_file({2, 1, 4, 8, 5}, "\0\0\0\0\0\0\0\xff"s, {tag}));
    EXPECT_EQ(inks.picture[0], (Rgba8{255, 255, 255}));
    EXPECT_GT(inks.picture[1].b, inks.picture[1].r + 60);
}

TEST_F(CodecProfiles, ProfilesThatDoNotFitAreIgnored) {
    for (const std::string& profile : {grey_profile(1), std::string("nonsense"), p3_profile().substr(0, 200)}) {
        const FileBytes png = png_with_chunks(png_file({1, 1, 8, 2}, "\xc8\x64\x32"s), iccp_chunk(profile));
        EXPECT_EQ(decoded(png).picture[0], (Rgba8{200, 100, 50})) << profile.size();
    }
}

TEST_F(CodecProfiles, OurOwnTagChangesNothing) {
    EncodeOptions options;
    options.format = "tif";
    EXPECT_EQ(largest_difference(decoded(encoded(quarters(), options)).picture, quarters()), 0);
}

TEST_F(CodecProfiles, OpenExrPrimariesAreConverted) {
    ExrKind kind;
    kind.channels = {"B", "G", "R"};
    // The primaries of Rec. 2020: its grey is grey, its half green lies outside sRGB towards no red.
    std::string xy;
    for (const float v : {0.708f, 0.292f, 0.170f, 0.797f, 0.131f, 0.046f, 0.3127f, 0.3290f}) xy += float_le(v);
    kind.attributes = exr_attribute("chromaticities", "chromaticities", xy);
    EXPECT_LE(difference(decoded(exr_file(kind, {0.5f, 0.5f, 0.5f})).picture[0], {188, 188, 188}), 2);
    const Rgba8 red = decoded(exr_file(kind, {0.1f, 0.1f, 0.4f})).picture[0];
    EXPECT_GT(red.r, srgb(0.4) + 10);
    EXPECT_LT(red.g, srgb(0.1) - 5);
}

}  // namespace
}  // namespace dstylize::test
