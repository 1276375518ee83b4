#include <map>
#include <string>

#include "unit/formats/codec_fixture.h"

namespace dstylize::test {
namespace {

/// The quarters as they have to be stored so that a viewer that obeys EXIF orientation shows them upright
/// (EXIF 2.3, 4.6.4: where the stored first row and first column lie in the upright picture).
Picture stored_for(int orientation, const Picture& upright) {
    const int w = upright.extent().x, h = upright.extent().y;
    const bool swaps = orientation >= 5;
    Picture stored(swaps ? Extent{h, w} : Extent{w, h});
    for (int y = 0; y < stored.extent().y; ++y)
        for (int x = 0; x < stored.extent().x; ++x) {
            const std::map<int, std::pair<int, int>> source = {
                {1, {x, y}},                  // row 0 is the top, column 0 the left side
                {2, {w - 1 - x, y}},          // top, right
                {3, {w - 1 - x, h - 1 - y}},  // bottom, right
                {4, {x, h - 1 - y}},          // bottom, left
                {5, {y, x}},                  // left, top
                {6, {w - 1 - y, x}},          // right, top
                {7, {w - 1 - y, h - 1 - x}},  // right, bottom
                {8, {y, h - 1 - x}},          // left, bottom
            };
            const auto [i, j] = source.at(orientation);
            stored(x, y) = upright(i, j);
        }
    return stored;
}

class CodecOrientation : public CodecTest {
  protected:
    FileBytes file_with(const std::string& format, const Picture& stored, int orientation, const char* order = "II") {
        EncodeOptions options;
        options.format = format;
        if (format == "webp") {
            options.quality = 100;
            options.metadata.dpi = 72;  // makes room for an EXIF chunk
        }
        const std::string exif = exif_with_orientation(orientation, order);
        if (format == "tif") {
            std::string samples;
            for (const Rgba8 c : stored) ((samples += char(c.r)) += char(c.g)) += char(c.b);
            TiffKind kind;
            kind.width = stored.extent().x;
            kind.height = stored.extent().y;
            return tiff_file(kind, samples, {tiff_short(274, {orientation})});
        }
        const FileBytes file = encoded(stored, options);
        if (format == "png") return png_with_chunks(file, png_chunk("eXIf", exif));
        if (format == "jpg") return jpeg_with_exif(file, exif);
        return webp_with_chunk(file, "EXIF", exif);
    }
};

TEST_F(CodecOrientation, AllEightAreTurnedUprightInAllFormats) {
    for (const char* format : {"png", "jpg", "tif", "webp"})
        for (int orientation = 1; orientation <= 8; ++orientation) {
            const Picture back = decoded(file_with(format, stored_for(orientation, quarters()), orientation)).picture;
            EXPECT_LE(largest_difference(back, quarters()), 12) << format << ", orientation " << orientation;
        }
}

TEST_F(CodecOrientation, ValuesOutsideOneToEightCountAsOne) {
    for (const char* format : {"png", "jpg", "tif", "webp"})
        for (const int orientation : {0, 9, 255, 65535})
            EXPECT_LE(largest_difference(decoded(file_with(format, quarters(), orientation)).picture, quarters()), 12)
                << format << ", orientation " << orientation;
}

TEST_F(CodecOrientation, BigEndianExifIsRead) {
    const FileBytes file = file_with("jpg", stored_for(6, quarters()), 6, "MM");
    EXPECT_LE(largest_difference(decoded(file).picture, quarters()), 12);
}

TEST_F(CodecOrientation, OutputIsUprightAndSaysSo) {
    const Picture upright = decoded(file_with("jpg", stored_for(8, quarters()), 8)).picture;
    for (const char* format : {"png", "jpg", "tif", "webp"}) {
        EncodeOptions options;
        options.format = format;
        EXPECT_EQ(decoded(encoded(upright, options)).picture.extent(), upright.extent());
    }
}

}  // namespace
}  // namespace dstylize::test
