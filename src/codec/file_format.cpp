#include "codec/file_format.h"

#include <cctype>
#include <iterator>
#include <string>
#include <string_view>

#include "codec/refusal.h"

namespace dstylize::codec {
namespace {

using namespace std::string_view_literals;

struct Magic {
    std::size_t offset;
    std::string_view bytes;
    const char* name;
};

/// What people most often try besides the formats that are read.
constexpr Magic kForeign[] = {
    {0, "8BPS"sv, "a Photoshop document"},
    {4, "ftypheic"sv, "a HEIC picture"},
    {4, "ftypheix"sv, "a HEIC picture"},
    {4, "ftypmif1"sv, "a HEIF picture"},
    {4, "ftypavif"sv, "an AVIF picture"},
    {4, "ftyp"sv, "a film"},
    {0, "\xff\x0a"sv, "a JPEG XL picture"},
    {4, "JXL \r\n"sv, "a JPEG XL picture"},
    {4, "jP  \r\n"sv, "a JPEG 2000 picture"},
    {0, "\xff\x4f\xff\x51"sv, "a JPEG 2000 picture"},
    {0, "%PDF"sv, "a PDF document"},
    {0, "%!PS"sv, "a PostScript document"},
    {0, "PK\3\4"sv, "a zip archive"},
    {0, "\x1f\x8b"sv, "a gzip archive"},
    {0, "<svg"sv, "an SVG drawing"},
    {0, "<?xml"sv, "an XML document"},
    {0, "<!DOCTYPE"sv, "a web page"},
    {0, "<html"sv, "a web page"},
    {0, "DDS "sv, "a DDS texture"},
    {0, "gimp xcf"sv, "a GIMP document"},
    {0, "\0\0\1\0"sv, "an icon"},
    {0, "SDPX"sv, "a DPX picture"},
    {0, "XPDS"sv, "a DPX picture"},
    {0, "SIMPLE  ="sv, "a FITS picture"},
    {0, "\x01\xda"sv, "an SGI picture"},
    {0, "RIFF"sv, "a sound or a film"},
    {0, "P7\n"sv, "a PAM picture"},
};

bool is_text(Bytes file) {
    const std::string_view head = text_of(part(file, 0, 512));
    return std::all_of(head.begin(), head.end(), [](unsigned char c) { return c >= 0x20 || std::isspace(c); });
}

/// The frame header's data, behind its length; empty when none is found.
Bytes jpeg_frame(Bytes file) {
    std::size_t at = 2;
    while (at + 9 <= file.size()) {
        if (file[at] != std::byte{0xff}) return {};
        const int marker = std::to_integer<int>(file[at + 1]);
        if (marker == 0xff || marker == 0x01 || (marker >= 0xd0 && marker <= 0xd8)) {
            at += marker == 0xff ? 1 : 2;
            continue;
        }
        const bool frame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
        if (frame) return part(file, at + 4);
        at += 2 + std::max<std::size_t>(2, integer_at(file, at + 2, 2, Endian::big));
    }
    return {};
}

}  // namespace

int jpeg_components(Bytes file) { return int(integer_at(jpeg_frame(file), 5, 1, Endian::big)); }

FileFormat recognised_format(Bytes file) {
    if (starts_with(file, "\x89PNG\r\n\x1a\n")) return FileFormat::png;
    if (starts_with(file, "\xff\xd8\xff")) return FileFormat::jpeg;
    for (const std::string_view tiff : {"II*\0"sv, "MM\0*"sv, "II+\0"sv, "MM\0+"sv})
        if (starts_with(file, tiff)) return FileFormat::tiff;
    if (starts_with(file, "RIFF") && starts_with(part(file, 8), "WEBP")) return FileFormat::webp;
    if (starts_with(file, "GIF87a") || starts_with(file, "GIF89a")) return FileFormat::gif;
    if (starts_with(file, "\x76\x2f\x31\x01")) return FileFormat::exr;
    if (starts_with(file, "#?RADIANCE") || starts_with(file, "#?RGBE")) return FileFormat::hdr;
    if (starts_with(file, "BM") && file.size() >= 18) return FileFormat::bmp;
    if (file.size() >= 3 && file[0] == std::byte{'P'} && std::isspace(std::to_integer<int>(file[2]))) {
        const char kind = char(file[1]);
        if ((kind >= '1' && kind <= '6') || kind == 'F' || kind == 'f') return FileFormat::pnm;
    }
    constexpr const char* kRemedy = "convert it to PNG, JPEG, TIFF or WebP";
    for (const Magic& magic : kForeign)
        if (starts_with(part(file, magic.offset), magic.bytes))
            throw Refusal(std::string("is ") + magic.name + ", which is not read", kRemedy);
    if (is_text(file)) throw Refusal("is a text file, not a picture", "give a picture");
    throw Refusal("is not a picture in a format that is read", kRemedy);
}

const char* reader_name(FileFormat format) {
    switch (format) {
        case FileFormat::png: return "png";
        case FileFormat::jpeg: return "jpeg";
        case FileFormat::tiff: return "tiff";
        case FileFormat::webp: return "webp";
        case FileFormat::bmp: return "bmp";
        case FileFormat::gif: return "gif";
        case FileFormat::pnm: return "pnm";
        case FileFormat::exr: return "openexr";
        case FileFormat::hdr: return "hdr";
    }
    return "";
}

std::optional<Extent> declared_extent(FileFormat format, Bytes file) {
    const auto extent = [&](std::size_t x_at, std::size_t y_at, int size, Endian endian) {
        const auto side = [&](std::size_t at) {
            const auto value = std::int64_t(std::int32_t(integer_at(file, at, size, endian)));
            return int(std::min<std::int64_t>(value < 0 ? -value : value, INT32_MAX));
        };
        return Extent{side(x_at), side(y_at)};
    };
    switch (format) {
        case FileFormat::png: return extent(16, 20, 4, Endian::big);
        case FileFormat::jpeg: {
            const Bytes frame = jpeg_frame(file);
            if (frame.empty()) return std::nullopt;
            return Extent{int(integer_at(frame, 3, 2, Endian::big)), int(integer_at(frame, 1, 2, Endian::big))};
        }
        case FileFormat::gif: return extent(6, 8, 2, Endian::little);
        case FileFormat::bmp:
            if (integer_at(file, 14, 4, Endian::little) == 12) return extent(18, 20, 2, Endian::little);
            return extent(18, 22, 4, Endian::little);
        default: return std::nullopt;
    }
}

}  // namespace dstylize::codec
