#include "unit/formats/picture_files.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

namespace dstylize::test {
namespace {

std::string number(std::uint64_t value, int size, bool big) {
    std::string bytes;
    for (int i = 0; i < size; ++i) bytes += char(value >> 8 * (big ? size - 1 - i : i) & 0xff);
    return bytes;
}

std::string padded(std::string text, std::size_t size) {
    text.resize(size);
    return text;
}

std::uint32_t crc32(std::string_view data) {
    std::uint32_t crc = ~0u;
    for (const char c : data) {
        crc ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0u);
    }
    return ~crc;
}

FileBytes with_inserted(const FileBytes& file, std::size_t at, std::string_view bytes) {
    std::string text = text_of(file);
    return file_of(text.insert(at, bytes));
}

std::string jpeg_segment(int marker, std::string_view data) {
    return std::string("\xff") + char(marker) + be(data.size() + 2, 2) + std::string(data);
}

/// The coded part of a JPEG: the highest bit first, a zero behind every byte of ones, ones at the end.
class BitsOfJpeg {
  public:
    void put(unsigned value, int count) {
        while (count-- > 0) put_bit(value >> count & 1);
    }
    std::string bytes() {
        while (filled_ != 0) put_bit(1);
        return bytes_;
    }

  private:
    void put_bit(unsigned bit) {
        byte_ = byte_ << 1 | bit;
        if (++filled_ < 8) return;
        bytes_ += char(byte_);
        if (byte_ == 0xff) bytes_ += '\0';
        byte_ = 0;
        filled_ = 0;
    }
    std::string bytes_;
    unsigned byte_ = 0;
    int filled_ = 0;
};

}  // namespace

FileBytes file_of(std::string_view text) {
    const auto* begin = reinterpret_cast<const std::byte*>(text.data());
    return {begin, begin + text.size()};
}
std::string text_of(const FileBytes& file) { return {reinterpret_cast<const char*>(file.data()), file.size()}; }

std::string le(std::uint64_t value, int size) { return number(value, size, false); }
std::string be(std::uint64_t value, int size) { return number(value, size, true); }
std::string float_le(float value) {
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof(bits));
    return le(bits, 4);
}

std::string exif_with_orientation(int orientation, std::string_view byte_order) {
    const bool big = byte_order == "MM";
    const auto n = [&](std::uint64_t value, int size) { return number(value, size, big); };
    return std::string(byte_order) + n(42, 2) + n(8, 4) + n(1, 2) +                    // one tag:
           n(0x0112, 2) + n(3, 2) + n(1, 4) + padded(n(orientation, 2), 4) + n(0, 4);  // orientation, a short
}

std::string png_chunk(std::string_view type, std::string_view data) {
    const std::string checked = std::string(type) + std::string(data);
    return be(data.size(), 4) + checked + be(crc32(checked), 4);
}

std::string stored_zlib(std::string_view data) {
    std::string out = "\x78\x01";
    std::uint32_t a = 1, b = 0;
    for (const char c : data) {
        a = (a + static_cast<unsigned char>(c)) % 65521;
        b = (b + a) % 65521;
    }
    do {
        const std::string_view block = data.substr(0, 65535);
        data.remove_prefix(block.size());
        out += char(data.empty());
        out += le(block.size(), 2) + le(~block.size() & 0xffff, 2);
        out += block;
    } while (!data.empty());
    return out + be(b << 16 | a, 4);
}

FileBytes png_file(const PngHeader& header, std::string_view rows, std::string_view chunks) {
    const std::size_t row_bytes = header.height ? rows.size() / header.height : 0;
    std::string filtered;
    for (std::size_t j = 0; j < header.height && row_bytes; ++j)
        (filtered += '\0') += rows.substr(j * row_bytes, row_bytes);
    const std::string ihdr = be(header.width, 4) + be(header.height, 4) + char(header.depth) +
                             char(header.colour_type) + std::string(3, '\0');
    return file_of("\x89PNG\r\n\x1a\n" + png_chunk("IHDR", ihdr) + std::string(chunks) +
                   png_chunk("IDAT", stored_zlib(filtered)) + png_chunk("IEND", ""));
}

FileBytes png_with_chunks(const FileBytes& png, std::string_view chunks) { return with_inserted(png, 33, chunks); }

FileBytes jpeg_with_exif(const FileBytes& jpeg, std::string_view exif) {
    return with_inserted(jpeg, 2, jpeg_segment(0xe1, std::string("Exif\0\0", 6) + std::string(exif)));
}

FileBytes jpeg_with_profile(const FileBytes& jpeg, std::string_view icc_profile) {
    // The one that is there loses its name.
    std::string text = text_of(jpeg);
    if (const auto old = text.find("ICC_PROFILE"); old != std::string::npos) text[old] = 'X';
    const std::string prefix("ICC_PROFILE\0\1\1", 14);
    return with_inserted(file_of(text), 2, jpeg_segment(0xe2, prefix + std::string(icc_profile)));
}

FileBytes cmyk_jpeg_file(const std::vector<std::array<int, 4>>& blocks, bool adobe) {
    std::string frame = be(8, 1) + be(8, 2) + be(8 * blocks.size(), 2) + be(4, 1), scan = be(4, 1);
    for (int ink = 1; ink <= 4; ++ink) {
        frame += be(std::uint64_t(ink), 1) + be(0x11, 1) + be(0, 1);
        scan += be(std::uint64_t(ink), 1) + be(0, 1);
    }
    // Twelve codes of four bits for how many bits the mean of a block has; one of one bit: nothing but the mean.
    std::string means = std::string("\0\0\0\0\x0c", 5) + std::string(12, '\0'), nothing("\x10\1", 2);
    for (int bits = 0; bits < 12; ++bits) means += char(bits);
    nothing += std::string(16, '\0');
    BitsOfJpeg bits;
    std::array<int, 4> last{128, 128, 128, 128};
    for (const std::array<int, 4>& block : blocks)
        for (std::size_t ink = 0; ink < 4; ++ink) {
            const int rise = block[ink] - last[ink], size = int(std::bit_width(unsigned(std::abs(rise))));
            bits.put(unsigned(size), 4);
            bits.put(unsigned(rise < 0 ? rise + (1 << size) - 1 : rise), size);
            bits.put(0, 1);
            last[ink] = block[ink];
        }
    return file_of("\xff\xd8" + (adobe ? jpeg_segment(0xee, std::string("Adobe\0\x64\0\0\0\0\0", 12)) : "") +
                   jpeg_segment(0xdb, '\0' + std::string(64, '\x08')) + jpeg_segment(0xc0, frame) +
                   jpeg_segment(0xc4, means) + jpeg_segment(0xc4, nothing) +
                   jpeg_segment(0xda, scan + std::string("\0\x3f\0", 3)) + bits.bytes() + "\xff\xd9");
}

FileBytes webp_with_chunk(const FileBytes& webp, std::string_view name, std::string_view content) {
    std::string text = text_of(webp), chunk = std::string(name) + le(content.size(), 4) + std::string(content);
    if (chunk.size() % 2) chunk += '\0';
    std::size_t at = 12;
    const auto size_at = [&](std::size_t offset) {
        std::size_t size = 0;
        for (int i = 3; i >= 0; --i) size = size << 8 | static_cast<unsigned char>(text[offset + std::size_t(i)]);
        return size;
    };
    while (at < text.size() && text.compare(at, 4, name) != 0) at += 8 + (size_at(at + 4) + 1) / 2 * 2;
    if (at >= text.size()) throw std::invalid_argument("the WebP has no such chunk");
    text.replace(at, 8 + (size_at(at + 4) + 1) / 2 * 2, chunk);
    return file_of(text.replace(4, 4, le(text.size() - 8, 4)));
}

TiffTagBytes tiff_short(int id, const std::vector<int>& values) {
    std::string bytes;
    for (const int value : values) bytes += le(std::uint64_t(value), 2);
    return {id, 3, std::uint32_t(values.size()), bytes};
}
TiffTagBytes tiff_long(int id, std::uint32_t value) { return {id, 4, 1, le(value, 4)}; }

FileBytes tiff_file(const TiffKind& kind, std::string_view samples, std::vector<TiffTagBytes> tags) {
    constexpr std::uint32_t kSamplesAt = 8;
    const auto add = [&](const TiffTagBytes& tag) {
        if (std::ranges::find(tags, tag.id, &TiffTagBytes::id) == tags.end()) tags.push_back(tag);
    };
    add(tiff_long(256, std::uint32_t(kind.width)));
    add(tiff_long(257, std::uint32_t(kind.height)));
    add(tiff_short(258, std::vector<int>(std::size_t(kind.samples), kind.bits)));
    add(tiff_short(259, {1}));
    add(tiff_short(262, {kind.photometric}));
    add(tiff_long(273, kSamplesAt));
    add(tiff_short(277, {kind.samples}));
    add(tiff_long(278, std::uint32_t(kind.height)));
    add(tiff_long(279, std::uint32_t(samples.size())));
    add(tiff_short(339, std::vector<int>(std::size_t(kind.samples), kind.sample_format)));
    if (kind.extra_sample >= 0) add(tiff_short(338, {kind.extra_sample}));
    std::ranges::sort(tags, {}, &TiffTagBytes::id);

    std::string body = padded(std::string(samples), (samples.size() + 1) / 2 * 2);
    const std::size_t directory_at = kSamplesAt + body.size();
    const std::size_t values_at = directory_at + 2 + tags.size() * 12 + 4;
    std::string directory = le(tags.size(), 2), values;
    for (const TiffTagBytes& tag : tags) {
        directory += le(std::uint64_t(tag.id), 2) + le(std::uint64_t(tag.type), 2) + le(tag.count, 4);
        if (tag.value.size() <= 4) {
            directory += padded(tag.value, 4);
        } else {
            directory += le(values_at + values.size(), 4);
            values += padded(tag.value, (tag.value.size() + 1) / 2 * 2);
        }
    }
    return file_of(std::string("II*\0", 4) + le(directory_at, 4) + body + directory + le(0, 4) + values);
}

std::string exr_attribute(std::string_view name, std::string_view type, std::string_view value) {
    return std::string(name) + '\0' + std::string(type) + '\0' + le(value.size(), 4) + std::string(value);
}

FileBytes exr_file(const ExrKind& kind, const std::vector<float>& samples) {
    const auto box = [](const int(&corners)[4]) {
        std::string bytes;
        for (const int corner : corners) bytes += le(std::uint32_t(corner), 4);
        return bytes;
    };
    std::string channels;
    for (const std::string& channel : kind.channels)
        channels += channel + '\0' + le(2, 4) + std::string(4, '\0') + le(1, 4) + le(1, 4);  // floats
    channels += '\0';
    std::string file = "\x76\x2f\x31\x01" + le(2, 4) + exr_attribute("channels", "chlist", channels) +
                       exr_attribute("compression", "compression", std::string(1, '\0')) +
                       exr_attribute("dataWindow", "box2i", box(kind.data)) +
                       exr_attribute("displayWindow", "box2i", box(kind.display)) +
                       exr_attribute("lineOrder", "lineOrder", std::string(1, '\0')) +
                       exr_attribute("pixelAspectRatio", "float", float_le(1)) +
                       exr_attribute("screenWindowCenter", "v2f", float_le(0) + float_le(0)) +
                       exr_attribute("screenWindowWidth", "float", float_le(1)) + kind.attributes + '\0';
    const auto width = std::size_t(kind.data[2] - kind.data[0] + 1),
               height = std::size_t(kind.data[3] - kind.data[1] + 1);
    const std::size_t row_floats = width * kind.channels.size(), row_bytes = row_floats * 4;
    assert(samples.size() == row_floats * height);
    const std::size_t rows_at = file.size() + height * 8;
    for (std::size_t j = 0; j < height; ++j) file += le(rows_at + j * (8 + row_bytes), 8);
    for (std::size_t j = 0; j < height; ++j) {
        file += le(std::uint32_t(kind.data[1] + int(j)), 4) + le(row_bytes, 4);
        for (std::size_t n = 0; n < row_floats; ++n) file += float_le(samples[j * row_floats + n]);
    }
    return file_of(file);
}

FileBytes hdr_file(int width, int height, std::string_view rgbe) {
    return file_of("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " +
                   std::to_string(width) + "\n" + std::string(rgbe));
}

FileBytes bmp_file(int width, int height, const std::vector<std::uint32_t>& masks, std::string_view rows) {
    std::string header = le(108, 4) + le(std::uint32_t(width), 4) + le(std::uint32_t(height), 4) + le(1, 2) +
                         le(32, 2) + le(masks.empty() ? 0 : 3, 4) + le(0, 4) + le(11811, 4) + le(11811, 4) + le(0, 4) +
                         le(0, 4);
    for (std::size_t n = 0; n < 4; ++n) header += le(n < masks.size() ? masks[n] : 0, 4);
    header.resize(108);
    return file_of("BM" + le(14 + 108 + rows.size(), 4) + le(0, 4) + le(14 + 108, 4) + header + std::string(rows));
}

FileBytes gif_file(int width, int height, const std::vector<Rgba8>& palette, const std::vector<int>& indices,
                   int transparent) {
    std::string file =
        "GIF89a" + le(std::uint64_t(width), 2) + le(std::uint64_t(height), 2) + "\x81" + std::string(2, '\0');
    for (const Rgba8 c : palette) ((file += char(c.r)) += char(c.g)) += char(c.b);
    if (transparent >= 0) file += std::string("\x21\xf9\x04\x01\0\0", 6) + char(transparent) + '\0';
    file += ',' + std::string(4, '\0') + le(std::uint64_t(width), 2) + le(std::uint64_t(height), 2) + '\0';
    // Codes of 3 bits, cleared before the table grows: each index stands for itself.
    std::string codes;
    int bits = 0, filled = 0;
    const auto put = [&](int code) {
        bits |= code << filled;
        for (filled += 3; filled >= 8; filled -= 8, bits >>= 8) codes += char(bits & 0xff);
    };
    for (std::size_t n = 0; n < indices.size(); ++n) {
        if (n % 2 == 0) put(4);
        put(indices[n]);
    }
    put(5);
    if (filled) codes += char(bits & 0xff);
    file += '\2';
    for (std::size_t at = 0; at < codes.size(); at += 255) {
        const std::string block = codes.substr(at, 255);
        file += char(block.size()) + block;
    }
    return file_of(file + '\0' + ';');
}

namespace {

std::string fixed(double value) { return be(std::uint32_t(std::int32_t(std::lround(value * 65536))), 4); }
std::string xyz_tag(const double (&xyz)[3]) {
    return std::string("XYZ \0\0\0\0", 8) + fixed(xyz[0]) + fixed(xyz[1]) + fixed(xyz[2]);
}
std::string gamma_tag(double gamma) {
    return std::string("curv\0\0\0\0", 8) + be(1, 4) + be(std::uint64_t(std::lround(gamma * 256)), 2) +
           std::string(2, '\0');
}

/// ICC.1:2001-04, version 2.
std::string icc_profile(std::string_view device_class, std::string_view space, std::string_view connection,
                        const std::vector<std::pair<std::string, std::string>>& tags) {
    std::string table = be(tags.size(), 4), data;
    const std::size_t data_at = 128 + 4 + tags.size() * 12;
    for (const auto& [name, content] : tags) {
        table += name + be(data_at + data.size(), 4) + be(content.size(), 4);
        data += padded(content, (content.size() + 3) / 4 * 4);
    }
    std::string header = be(data_at + data.size(), 4) + std::string(4, '\0') + be(0x02100000, 4) +
                         std::string(device_class) + std::string(space) + std::string(connection) +
                         std::string(12, '\0') + "acsp";
    header = padded(header, 68) + fixed(0.9642) + fixed(1) + fixed(0.8249);
    return padded(header, 128) + table + data;
}

}  // namespace

std::string rgb_profile(const double (&red)[3], const double (&green)[3], const double (&blue)[3], double gamma) {
    return icc_profile("mntr", "RGB ", "XYZ ",
                       {{"wtpt", xyz_tag({0.9642, 1, 0.8249})},
                        {"rXYZ", xyz_tag(red)},
                        {"gXYZ", xyz_tag(green)},
                        {"bXYZ", xyz_tag(blue)},
                        {"rTRC", gamma_tag(gamma)},
                        {"gTRC", gamma_tag(gamma)},
                        {"bTRC", gamma_tag(gamma)}});
}

std::string p3_profile() {
    return rgb_profile({0.51512, 0.2412, -0.00105}, {0.29198, 0.69225, 0.04189}, {0.1571, 0.06657, 0.78407}, 2.2);
}

std::string grey_profile(double gamma) {
    return icc_profile("mntr", "GRAY", "XYZ ", {{"wtpt", xyz_tag({0.9642, 1, 0.8249})}, {"kTRC", gamma_tag(gamma)}});
}

std::string cmyk_profile(const double (&paper)[3], const double (&ink)[3]) {
    const auto lab8 = [](const double(&lab)[3]) {
        return std::string{char(std::lround(lab[0] * 255 / 100)), char(std::lround(lab[1] + 128)),
                           char(std::lround(lab[2] + 128))};
    };
    std::string ramp;
    for (int n = 0; n < 256; ++n) ramp += char(n);
    // lut8: 4 inputs, 3 outputs, 2 grid points; the last input, black, varies fastest.
    std::string table = std::string("mft1\0\0\0\0\4\3\2\0", 12);
    for (int n = 0; n < 9; ++n) table += fixed(n % 4 == 0 ? 1 : 0);
    for (int n = 0; n < 4; ++n) table += ramp;
    for (int n = 0; n < 8; ++n) table += lab8(paper) + lab8(ink);
    for (int n = 0; n < 3; ++n) table += ramp;
    return icc_profile("prtr", "CMYK", "Lab ",
                       {{"wtpt", xyz_tag({0.9642, 1, 0.8249})}, {"A2B0", table}, {"A2B1", table}});
}

}  // namespace dstylize::test
