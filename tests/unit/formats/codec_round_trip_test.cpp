#include <string>

#include "unit/formats/codec_fixture.h"

namespace dstylize::test {
namespace {

class CodecRoundTrip : public CodecTest, public testing::WithParamInterface<const char*> {
  protected:
    EncodeOptions options() const {
        EncodeOptions options;
        options.format = GetParam();
        if (options.format == "webp") options.quality = 100;
        return options;
    }
    bool is_jpeg() const { return options().format == "jpg"; }
};
INSTANTIATE_TEST_SUITE_P(, CodecRoundTrip, testing::Values("png", "jpg", "tif", "webp"),
                         [](const auto& format) { return std::string(format.param); });

Picture gradient(Extent extent, bool transparent) {
    Picture picture(extent);
    for (int j = 0; j < extent.y; ++j)
        for (int i = 0; i < extent.x; ++i)
            picture(i, j) = {std::uint8_t(i * 255 / std::max(1, extent.x - 1)), std::uint8_t(j * 7),
                             std::uint8_t(90 + i - j),
                             transparent ? std::uint8_t(i < 3 ? 0 : std::min(255, i * 9)) : std::uint8_t(255)};
    return picture;
}

TEST_P(CodecRoundTrip, KeepsPixels) {
    for (const Extent extent : {Extent{1, 1}, Extent{37, 21}, Extent{1, 300}, Extent{130, 65}}) {
        const Picture picture = gradient(extent, false);
        const DecodedPicture back = decoded(encoded(picture, options()));
        EXPECT_LE(largest_difference(back.picture, picture), is_jpeg() ? 12 : 0) << extent.x << " x " << extent.y;
        EXPECT_FALSE(back.has_alpha);
    }
}

TEST_P(CodecRoundTrip, KeepsAlphaAndTheColoursUnderIt) {
    if (is_jpeg()) GTEST_SKIP() << "JPEG has no alpha";
    const Picture picture = gradient({37, 21}, true);
    const DecodedPicture back = decoded(encoded(picture, options()));
    EXPECT_EQ(largest_difference(back.picture, picture), 0);
    EXPECT_TRUE(back.has_alpha);
}

TEST_P(CodecRoundTrip, KeepsMetadata) {
    EncodeOptions wanted = options();
    wanted.metadata.dpi = 300;
    wanted.metadata.text = {{"author", "Zoë & José <studio>"},
                            {"copyright", "© 2026; \"all\" rights"},
                            {"description", "first line\nsecond line"},
                            {"software", "dstylize 1.2"},
                            {"recipe", "[stage]\nname = \"<&>\" # ü &amp;\n" + std::string(20'000, 'r')},
                            {"seed", "0042"}};
    const PictureMetadata back = decoded(encoded(quarters(), wanted)).metadata;
    EXPECT_EQ(back.dpi, 300);
    for (const auto& [key, value] : wanted.metadata.text) EXPECT_EQ(back.find(key), value) << key;
    EXPECT_EQ(back.text.size(), wanted.metadata.text.size());
}

TEST_P(CodecRoundTrip, StatesNothingThatItWasNotTold) {
    const PictureMetadata back = decoded(encoded(quarters(), options())).metadata;
    EXPECT_EQ(back.dpi, 0);
    EXPECT_EQ(back.find("author") + back.find("copyright") + back.find("description") + back.find("recipe"), "");
}

TEST_P(CodecRoundTrip, GivesTheSameBytesForTheSamePicture) {
    EncodeOptions wanted = options();
    wanted.metadata.text = {{"recipe", "x"}};
    PictureCodec other(codec_options());
    EXPECT_EQ(encoded(quarters(), wanted), other.encode(quarters(), wanted, "picture"));
}

TEST_P(CodecRoundTrip, TagsOutputAsSrgb) {
    const std::string file = text_of(encoded(quarters(), options()));
    const bool png_chunk = file.find("sRGB") != std::string::npos && options().format == "png";
    EXPECT_TRUE(png_chunk || file.find("acsp") != std::string::npos);
}

using CodecEncode = CodecTest;

TEST_F(CodecEncode, KeepsFullColourResolutionInJpegs) {
    // One-pixel stripes of equal luma: chroma at half resolution would blur them to grey.
    Picture picture({32, 32});
    for (int j = 0; j < 32; ++j)
        for (int i = 0; i < 32; ++i) picture(i, j) = i % 2 ? Rgba8{200, 90, 90} : Rgba8{70, 150, 120};
    EncodeOptions options;
    options.format = "jpg";
    EXPECT_LE(largest_difference(decoded(encoded(picture, options)).picture, picture), 25);
}

TEST_F(CodecEncode, RefusesARecipeThatAJpegCannotHold) {
    EncodeOptions options;
    options.format = "jpg";
    options.metadata.text = {{"recipe", std::string(70'000, 'r')}};
    const Error error = error_of([&] { encoded(quarters(), options); });
    EXPECT_EQ(error.code(), ErrorCode::cannot_write);
    EXPECT_NE(error.problem().find("JPEG"), std::string::npos);
}

TEST_F(CodecEncode, RefusesSidesBeyondTheFormat) {
    EncodeOptions options;
    options.format = "webp";
    EXPECT_EQ(error_of([&] { encoded(Picture({16'384, 1}), options); }).code(), ErrorCode::cannot_write);
    options.format = "jpg";
    EXPECT_EQ(error_of([&] { encoded(Picture({1, 65'501}), options); }).code(), ErrorCode::cannot_write);
    options.format = "png";
    EXPECT_EQ(decoded(encoded(Picture({1, 70'000}), options)).picture.extent(), (Extent{1, 70'000}));
}

TEST_F(CodecEncode, RefusesAnUnknownFormat) {
    EncodeOptions options;
    options.format = "xyz";
    EXPECT_EQ(error_of([&] { encoded(quarters(), options); }).code(), ErrorCode::cannot_write);
}

TEST_F(CodecEncode, QualityAndCompressionTrade) {
    const auto bytes = [&](const char* format, int quality, int compression) {
        EncodeOptions options;
        options.format = format;
        options.quality = quality;
        options.compression = compression;
        return encoded(gradient({200, 200}, false), options).size();
    };
    EXPECT_GT(bytes("jpg", 95, 1), bytes("jpg", 50, 1));
    EXPECT_GT(bytes("webp", 95, 1), bytes("webp", 50, 1));
    EXPECT_GT(bytes("png", 92, 0), bytes("png", 92, 9));
    EXPECT_GT(bytes("tif", 92, 0), bytes("tif", 92, 9));
}

}  // namespace
}  // namespace dstylize::test
