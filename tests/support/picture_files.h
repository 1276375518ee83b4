#pragma once
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "formats/picture_codec.h"
#include "support/temp_folder.h"

namespace dstylize::test {

/// The codec that was built with the tests.
inline PictureCodec& codec() {
    static PictureCodec instance({DSTYLIZE_CODEC, 4ull << 30, 120, false});
    return instance;
}

inline void write_picture(const std::filesystem::path& path, const Picture& picture, PictureMetadata metadata = {}) {
    EncodeOptions options;
    options.format = path.extension().string().substr(1);
    options.metadata = std::move(metadata);
    write_file(path, codec().encode(picture, options, path.string()));
}

/// Throws Error when the file is not a whole picture.
inline DecodedPicture read_picture(const std::filesystem::path& path) {
    const std::string bytes = file_bytes(path);
    return codec().decode(std::as_bytes(std::span(bytes)), path.string());
}

/// Little-endian bytes, for files that the codec does not write.
class ByteWriter {
  public:
    template <class Number>
    ByteWriter& number(Number value) {
        static_assert(std::endian::native == std::endian::little);
        char bytes[sizeof value];
        std::memcpy(bytes, &value, sizeof value);
        out_.append(bytes, sizeof value);
        return *this;
    }
    ByteWriter& text(std::string_view value) {
        out_ += value;
        return *this;
    }
    ByteWriter& name(std::string_view value) { return text(value).number(char(0)); }
    std::size_t size() const { return out_.size(); }
    const std::string& bytes() const { return out_; }

  private:
    std::string out_;
};

/// A portable pixmap of 16 bits a channel: a ramp from black to white.
inline std::string pnm16(int width, int height) {
    std::string out = "P6\n" + std::to_string(width) + " " + std::to_string(height) + "\n65535\n";
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) {
                const unsigned v = 65535u * unsigned(x) / unsigned(width > 1 ? width - 1 : 1);
                out += char(v >> 8);
                out += char(v & 255);
            }
    return out;
}

/// An uncompressed CMYK TIFF: the left half cyan ink, the right half black ink.
inline std::string cmyk_tiff(int width, int height) {
    const auto samples = std::uint32_t(width * height * 4);
    constexpr std::uint16_t kShort = 3, kLong = 4;
    ByteWriter file;
    file.text("II").number(std::uint16_t(42)).number(std::uint32_t(8 + samples + 8));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const bool left = x < width / 2;
            file.number(std::uint8_t(left ? 255 : 0)).number(std::uint8_t(0)).number(std::uint8_t(0));
            file.number(std::uint8_t(left ? 0 : 255));
        }
    for (int channel = 0; channel < 4; ++channel) file.number(std::uint16_t(8));  // bits per sample
    const auto entry = [&](std::uint16_t tag, std::uint16_t type, std::uint32_t count, std::uint32_t value) {
        file.number(tag).number(type).number(count).number(value);
    };
    file.number(std::uint16_t(10));
    entry(256, kLong, 1, std::uint32_t(width));
    entry(257, kLong, 1, std::uint32_t(height));
    entry(258, kShort, 4, 8 + samples);
    entry(259, kShort, 1, 1);
    entry(262, kShort, 1, 5);  // separated inks
    entry(273, kLong, 1, 8);
    entry(277, kShort, 1, 4);
    entry(278, kLong, 1, std::uint32_t(height));
    entry(279, kLong, 1, samples);
    entry(284, kShort, 1, 1);
    return file.number(std::uint32_t(0)).bytes();
}

/// An uncompressed OpenEXR picture of one grey value, every seventh pixel not a number.
inline std::string exr_with_nan(int width, int height) {
    ByteWriter file;
    file.number(std::uint32_t(20000630)).number(std::uint32_t(2));
    const auto attribute = [&](const char* key, const char* type, const ByteWriter& value) {
        file.name(key).name(type).number(std::uint32_t(value.size())).text(value.bytes());
    };
    ByteWriter channels;
    for (const char* channel : {"B", "G", "R"}) {
        channels.name(channel).number(std::uint32_t(2)).number(std::uint32_t(0));
        channels.number(std::uint32_t(1)).number(std::uint32_t(1));
    }
    channels.number(char(0));
    ByteWriter box;
    box.number(0).number(0).number(width - 1).number(height - 1);
    attribute("channels", "chlist", channels);
    attribute("compression", "compression", ByteWriter().number(char(0)));
    attribute("dataWindow", "box2i", box);
    attribute("displayWindow", "box2i", box);
    attribute("lineOrder", "lineOrder", ByteWriter().number(char(0)));
    attribute("pixelAspectRatio", "float", ByteWriter().number(1.0f));
    attribute("screenWindowCenter", "v2f", ByteWriter().number(0.0f).number(0.0f));
    attribute("screenWindowWidth", "float", ByteWriter().number(1.0f));
    file.number(char(0));
    const auto row_bytes = std::uint32_t(width * 3 * 4);
    const std::size_t rows_start = file.size() + std::size_t(height) * 8;
    for (int y = 0; y < height; ++y) file.number(std::uint64_t(rows_start + std::size_t(y) * (8 + row_bytes)));
    for (int y = 0; y < height; ++y) {
        file.number(y).number(row_bytes);
        for (int i = 0; i < 3 * width; ++i)
            file.number((i + y) % 7 == 0 ? std::numeric_limits<float>::quiet_NaN() : 0.25f);
    }
    return file.bytes();
}

}  // namespace dstylize::test
