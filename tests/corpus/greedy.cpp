#include <zlib.h>

#include <algorithm>

#include "corpus/sound.h"

namespace dstylize::test {
namespace {

constexpr std::uint32_t kMost = 65535;

/// zlib's format of that many zero bytes, a thousandth of them.
std::string packed_zeros(std::size_t bytes) {
    const std::string part(1 << 16, '\0');
    std::string out, buffer(1 << 16, '\0');
    z_stream stream{};
    deflateInit(&stream, Z_BEST_COMPRESSION);
    for (std::size_t done = 0; done < bytes; done += part.size()) {
        const std::size_t more = std::min(part.size(), bytes - done);
        stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(part.data()));
        stream.avail_in = uInt(more);
        do {
            stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
            stream.avail_out = uInt(buffer.size());
            deflate(&stream, done + more < bytes ? Z_NO_FLUSH : Z_FINISH);
            out.append(buffer.data(), buffer.size() - stream.avail_out);
        } while (stream.avail_out == 0);
    }
    deflateEnd(&stream);
    return out;
}

/// A whole picture of one grey bit a pixel.
FileBytes png_bomb(std::uint32_t side) {
    const std::string header = be(side, 4) + be(side, 4) + std::string("\1\0\0\0\0", 5);
    return file_of("\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) +
                   png_chunk("IDAT", packed_zeros(std::size_t(side) * ((side + 7) / 8 + 1))) + png_chunk("IEND", ""));
}

/// A header, and no data behind it.
FileBytes jpeg_header(std::uint32_t side) {
    return file_of("\xff\xd8\xff\xc0" + be(17, 2) + be(8, 1) + be(side, 2) + be(side, 2) +
                   std::string("\3\1\x11\0\2\x11\1\3\x11\1", 10) + "\xff\xd9");
}

FileBytes exr_of_large_window() {
    ExrKind kind;
    kind.display[2] = kind.display[3] = int(kMost) - 1;
    kind.channels = {"B", "G", "R"};
    return exr_file(kind, std::vector<float>(3, 0.5f));
}

FileBytes tiff_of_one_endless_strip() {
    TiffKind kind;
    kind.width = kind.height = 64;
    return tiff_file(kind, std::string(std::size_t(64) * 64 * 3, '\x40'), {tiff_long(278, 0x7fffffff)});
}

FileBytes large_tiff() {
    TiffKind kind;
    kind.width = kind.height = int(kMost);
    return tiff_file(kind, std::string(1000, '\0'));
}

}  // namespace

std::vector<CorpusFile> greedy_pictures() {
    const std::string sides = std::to_string(kMost) + " " + std::to_string(kMost);
    return {{"header.png", png_file({kMost, kMost, 8, 6}, ""), {}},
            {"bomb.png", png_bomb(30000), {}},
            {"header.jpg", jpeg_header(kMost), {}},
            {"header.tif", large_tiff(), {}},
            {"strip.tif", tiff_of_one_endless_strip(), {}},
            {"header.bmp", bmp_file(int(kMost), int(kMost), {0xff0000, 0xff00, 0xff, 0}, ""), {}},
            {"header.gif", gif_file(int(kMost), int(kMost), {{0, 0, 0, 255}}, {}, -1), {}},
            {"header.hdr", hdr_file(int(kMost), int(kMost), ""), {}},
            {"header.ppm", file_of("P6\n" + sides + "\n255\n"), {}},
            {"header.webp",
             file_of("RIFF" + le(30, 4) + "WEBPVP8L" + le(17, 4) + "\x2f" + le(0x0fffffff, 4) + std::string(13, '\0')),
             {}},
            {"window.exr", exr_of_large_window(), {}}};
}

}  // namespace dstylize::test
