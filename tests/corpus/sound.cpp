#include "corpus/sound.h"

#include "support/scenes.h"

namespace dstylize::test {
namespace {

constexpr Extent kSmall{24, 18};

std::string ramp(std::size_t bytes) {
    std::string out;
    for (std::size_t n = 0; n < bytes; ++n) out += char(n * 37 % 251);
    return out;
}

void add_encoded(std::vector<CorpusFile>& files, PictureCodec& codec) {
    Picture translucent = scene(kSmall);
    for (std::size_t n = 0; n < translucent.size(); ++n) translucent[n].a = std::uint8_t(n * 11);
    for (const char* const format : {"png", "jpg", "tif", "webp"}) {
        EncodeOptions options;
        options.format = format;
        options.metadata.text = {{"Author", "nobody"}};
        options.metadata.dpi = 200;
        files.push_back({std::string("plain.") + format, codec.encode(scene(kSmall), options, "plain"), kSmall});
        if (options.format != "jpg")
            files.push_back({std::string("glass.") + format, codec.encode(translucent, options, "glass"), kSmall});
    }
    EncodeOptions packed;
    packed.format = "tif";
    packed.compression = 6;
    files.push_back({"packed.tif", codec.encode(scene(kSmall), packed, "packed"), kSmall});
    EncodeOptions lossless;
    lossless.format = "webp";
    lossless.quality = 100;
    files.push_back({"lossless.webp", codec.encode(scene(kSmall), lossless, "lossless"), kSmall});
    EncodeOptions jpeg;
    jpeg.format = "jpg";
    files.push_back({"turned.jpg",
                     jpeg_with_exif(codec.encode(scene(kSmall), jpeg, "turned"), exif_with_orientation(6)),
                     {kSmall.y, kSmall.x}});
}

void add_written(std::vector<CorpusFile>& files) {
    const auto [w, h, depth] = kSmall;
    const auto pixels = std::size_t(w * h);
    for (const int colour : {0, 2, 4, 6}) {
        const int channels = colour == 0 ? 1 : colour == 2 ? 3 : colour == 4 ? 2 : 4;
        const PngHeader header{std::uint32_t(w), std::uint32_t(h), 16, colour};
        files.push_back({"deep" + std::to_string(colour) + ".png",
                         png_file(header, ramp(pixels * std::size_t(channels) * 2)), kSmall});
    }
    TiffKind tiff;
    tiff.width = w;
    tiff.height = h;
    files.push_back({"written.tif", tiff_file(tiff, ramp(pixels * 3)), kSmall});
    tiff.photometric = 5;
    tiff.samples = 4;
    files.push_back({"inks.tif", tiff_file(tiff, ramp(pixels * 4)), kSmall});
    files.push_back({"inks.jpg", cmyk_jpeg_file({{0, 80, 160, 240}, {255, 7, 77, 0}, {9, 9, 9, 9}}, true), {24, 8}});
    files.push_back({"masks.bmp", bmp_file(w, h, {0xff0000, 0xff00, 0xff, 0xff000000u}, ramp(pixels * 4)), kSmall});
    std::vector<int> indices(pixels);
    for (std::size_t n = 0; n < pixels; ++n) indices[n] = int(n % 4);
    const std::vector<Rgba8> palette{{0, 0, 0, 255}, {255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}};
    files.push_back({"palette.gif", gif_file(w, h, palette, indices, 2), kSmall});
    files.push_back({"radiance.hdr", hdr_file(w, h, ramp(pixels * 4)), kSmall});
    ExrKind exr;
    exr.data[2] = exr.display[2] = w - 1;
    exr.data[3] = exr.display[3] = h - 1;
    exr.channels = {"B", "G", "R"};
    files.push_back({"floats.exr", exr_file(exr, std::vector<float>(pixels * 3, 0.25f)), kSmall});
    const std::string size = std::to_string(w) + " " + std::to_string(h);
    files.push_back({"colour.ppm", file_of("P6\n" + size + "\n255\n" + ramp(pixels * 3)), kSmall});
    files.push_back({"grey.pgm", file_of("P5\n# grey\n" + size + "\n65535\n" + ramp(pixels * 2)), kSmall});
}

}  // namespace

std::vector<CorpusFile> sound_pictures(PictureCodec& codec) {
    std::vector<CorpusFile> files;
    add_encoded(files, codec);
    add_written(files);
    return files;
}

}  // namespace dstylize::test
