#include <string>

#include "unit/formats/codec_fixture.h"

namespace dstylize::test {
namespace {

using namespace std::string_literals;

class CodecBadInput : public CodecTest {
  protected:
    static Error refusal(const FileBytes& file) {
        Error error = error_of([&] { decoded(file); });
        EXPECT_EQ(error.code(), ErrorCode::cannot_read);
        EXPECT_EQ(error.file(), "picture");
        EXPECT_FALSE(error.problem().empty());
        EXPECT_FALSE(error.remedy().empty());
        // Whatever it was, the next picture is read.
        EXPECT_EQ(decoded(png_file({1, 1, 8, 0}, "\x07"s)).picture[0], (Rgba8{7, 7, 7}));
        return error;
    }
    /// Full of detail, so that its file is long.
    static FileBytes photo(const char* format) {
        Picture picture({300, 200});
        for (int j = 0; j < 200; ++j)
            for (int i = 0; i < 300; ++i)
                picture(i, j) = {std::uint8_t(i * j % 251), std::uint8_t(i * 3 + j), std::uint8_t(i * i * j % 241)};
        EncodeOptions options;
        options.format = format;
        return encoded(picture, options);
    }
    static FileBytes cut(FileBytes file, double share) {
        file.resize(std::size_t(double(file.size()) * share));
        return file;
    }
};

TEST_F(CodecBadInput, EmptyAndStrangeFilesAreNamed) {
    EXPECT_EQ(refusal({}).problem(), "is empty");
    EXPECT_NE(refusal(file_of("Dear reader,\nthis is no picture.\n")).problem().find("text file"), std::string::npos);
    EXPECT_NE(refusal(file_of("8BPS\0\1"s)).problem().find("Photoshop"), std::string::npos);
    EXPECT_NE(refusal(file_of("\0\0\0\x18"
                              "ftypheic"s))
                  .problem()
                  .find("HEIC"),
              std::string::npos);
    EXPECT_NE(refusal(file_of("%PDF-1.7")).problem().find("PDF"), std::string::npos);
    EXPECT_NE(refusal(file_of("RIFF\0\0\0\0WAVE"s)).problem().find("sound"), std::string::npos);
    refusal(file_of(std::string(1000, '\0')));
    refusal(
        file_of("\x7f"
                "ELF\2\1\1"));
}

TEST_F(CodecBadInput, OnlyAMagicNumberIsDamage) {
    for (const std::string& magic : {"\x89PNG\r\n\x1a\n"s, "\xff\xd8\xff\xe0"s, "II*\0"s, "MM\0*"s, "RIFF\4\0\0\0WEBP"s,
                                     "GIF89a"s, "BM"s, "P6\n"s, "P1\n"s, "\x76\x2f\x31\x01"s, "#?RADIANCE\n"s})
        refusal(file_of(magic));
}

TEST_F(CodecBadInput, TruncatedFilesAreDamagedUnlessThatIsAllowed) {
    CodecOptions lenient = codec_options();
    lenient.allow_damaged = true;
    PictureCodec taking(lenient);
    for (const char* format : {"png", "jpg", "webp"}) {
        const FileBytes whole = photo(format);
        const Picture expected = decoded(whole).picture;
        for (const double share : {0.3, 0.6, 0.95}) {
            const FileBytes part = cut(whole, share);
            EXPECT_NE(refusal(part).problem().find("damaged"), std::string::npos) << format << ' ' << share;
            const DecodedPicture taken = taking.decode(part, "picture");
            ASSERT_EQ(taken.picture.extent(), expected.extent()) << format << ' ' << share;
            int good = 0;
            for (int j = 0; j < 10; ++j)
                for (int i = 0; i < 300; ++i) good += difference(taken.picture(i, j), expected(i, j)) <= 2;
            EXPECT_GT(good, 2700) << format << ' ' << share;
        }
        EXPECT_EQ(largest_difference(taking.decode(whole, "picture").picture, expected), 0);
    }
}

TEST_F(CodecBadInput, CutJpegsOfInksAreDamagedAtEveryPlace) {
    const FileBytes whole = cmyk_jpeg_file({{0, 80, 160, 240}, {255, 7, 77, 0}, {9, 9, 9, 9}, {3, 200, 1, 90}}, true);
    for (std::size_t size = 30; size + 2 < whole.size(); size += 13)
        refusal(FileBytes(whole.begin(), whole.begin() + std::ptrdiff_t(size)));
}

TEST_F(CodecBadInput, BrokenChecksumsAreDamage) {
    FileBytes png = photo("png");
    png[png.size() / 2] ^= std::byte{0x40};
    refusal(png);
}

TEST_F(CodecBadInput, HeadersThatClaimTooMuchAreRefusedBeforeAnythingIsAllocated) {
    const std::uint32_t most = 65'535;
    for (const FileBytes& bomb :
         {png_file({most, most, 8, 2}, ""), png_file({1u << 30, 1u << 30, 16, 6}, ""),
          file_of("P6\n65535 65535\n255\n"), bmp_file(int(most), int(most), {}, ""), hdr_file(int(most), int(most), ""),
          tiff_file({int(most), int(most), 3, 8}, ""),
          file_of("\xff\xd8\xff\xc0\0\x11\x08\xff\xff\xff\xff\3\1\x11\0\2\x11\0\3\x11\0\xff\xd9"s)}) {
        const Error error = refusal(bomb);
        EXPECT_NE(error.problem().find("memory limit of 4096 MB"), std::string::npos) << error.what();
        EXPECT_NE(error.remedy().find("--max-memory"), std::string::npos);
    }
    ExrKind exr;
    exr.channels = {"Y"};
    exr.display[2] = exr.display[3] = 60'000;
    EXPECT_NE(refusal(exr_file(exr, {1})).problem().find("60001 x 60001"), std::string::npos);
}

TEST_F(CodecBadInput, PicturesWithoutPixelsAreRefused) {
    refusal(png_file({0, 5, 8, 0}, ""));
    refusal(file_of("P5\n0 5\n255\n"));
    refusal(tiff_file({0, 5, 1, 8, 1}, ""));
    refusal(bmp_file(0, 5, {}, ""));
}

TEST_F(CodecBadInput, TheMemoryLimitHolds) {
    CodecOptions small = codec_options();
    small.max_memory_bytes = 8 << 20;
    PictureCodec codec(small);
    EXPECT_EQ(codec.decode(png_file({100, 100, 8, 0}, std::string(10'000, '\7')), "small").picture[0],
              (Rgba8{7, 7, 7}));
    const Error error = error_of([&] {
        codec.decode(png_file({2000, 2000, 8, 0}, std::string(4'000'000, '\7')), "big");
    });
    EXPECT_EQ(error.code(), ErrorCode::cannot_read);
    EXPECT_NE(error.problem().find("8 MB"), std::string::npos);
    EXPECT_EQ(error.file(), "big");
}

TEST_F(CodecBadInput, MoreRowsPerStripThanRowsAreNoEndlessLoop) {
    const FileBytes tiff = tiff_file({2, 2, 1, 8, 1}, "\1\2\3\4"s, {tiff_long(278, 0x7fffffff)});
    EXPECT_EQ(decoded(tiff).picture(1, 1), (Rgba8{4, 4, 4}));
}

TEST_F(CodecBadInput, TilesFarLargerThanThePictureAreRefused) {
    EXPECT_NE(
        refusal(tiff_file({1, 500, 1, 8, 1}, std::string(500, '\7'), {tiff_long(322, 0x7ffffff0), tiff_long(323, 1)}))
            .problem()
            .find("tiles"),
        std::string::npos);
}

TEST_F(CodecBadInput, DirectoriesThatPointAnywhereAreSafe) {
    std::string tiff = text_of(tiff_file({1, 1, 3, 8}, "abc"));
    for (const std::uint32_t offset : {0u, 1u, 7u, 8u, 0x7fffffffu, 0xfffffffeu, std::uint32_t(tiff.size() - 1)})
        refusal(file_of(tiff.replace(4, 4, le(offset, 4))));
    // The same in an EXIF block, where the picture itself is sound.
    for (const std::uint32_t offset : {0u, 7u, 0xfffffffeu}) {
        std::string exif = exif_with_orientation(6);
        exif.replace(4, 4, le(offset, 4));
        const FileBytes png = png_file({2, 1, 8, 0}, "\1\2"s, png_chunk("eXIf", exif));
        EXPECT_EQ(decoded(png).picture.extent(), (Extent{2, 1}));
    }
}

TEST_F(CodecBadInput, ForeignMetadataIsMadeSafe) {
    // Latin-1, control characters and all, in what becomes UTF-8 text.
    const FileBytes png = png_file({1, 1, 8, 0}, "\7"s, png_chunk("tEXt", "Author\0Jos\xe9\x01\x1b[31m"s));
    EXPECT_EQ(decoded(png).metadata.find("author"), "José[31m");
}

}  // namespace
}  // namespace dstylize::test
