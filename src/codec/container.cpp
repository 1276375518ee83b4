// Puts EXIF, XMP, text and profiles into the files that OpenImageIO wrote, and finds them in files that
// are read. OpenImageIO 2.4 could do some of it, but writes XMP without escaping, the time of day into
// every TIFF, and no text of ours.
#include "codec/container.h"

#include <zlib.h>

#include <string_view>

#include "codec/refusal.h"
#include "ipc/shared_memory.h"

namespace dstylize::codec {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kJpegExif = "Exif\0\0"sv;
constexpr std::string_view kJpegXmp = "http://ns.adobe.com/xap/1.0/\0"sv;
constexpr std::string_view kJpegIcc = "ICC_PROFILE\0\1\1"sv;  // part 1 of 1
constexpr std::string_view kPngXmp = "XML:com.adobe.xmp\0\0\0\0\0"sv;
constexpr int kApp0 = 0xe0, kApp1 = 0xe1, kApp2 = 0xe2, kStartOfScan = 0xda;

/// Calls `use(marker, whole segment)` for each segment before the picture data; returns where those end.
template <class Use>
std::size_t for_each_jpeg_segment(Bytes file, Use use) {
    std::size_t at = 2;
    while (at + 4 <= file.size() && file[at] == std::byte{0xff}) {
        const int marker = std::to_integer<int>(file[at + 1]);
        if (marker == kStartOfScan) break;
        if (marker == 0xff) {  // padding
            ++at;
            continue;
        }
        const std::size_t size = 2 + integer_at(file, at + 2, 2, Endian::big);
        if (size < 4) break;
        use(marker, part(file, at, size));
        at += size;
    }
    return at;
}

/// Calls `use(type, data)` for each chunk up to the picture data.
template <class Use>
void for_each_png_chunk(Bytes file, Use use) {
    std::size_t at = 8;
    while (at + 12 <= file.size()) {
        const std::size_t size = integer_at(file, at, 4, Endian::big);
        const std::string_view type = text_of(part(file, at + 4, 4));
        use(type, part(file, at + 8, size));
        if (type == "IEND") break;
        at += 12 + size;
    }
}

std::string jpeg_segment(int marker, std::string_view prefix, std::string_view content, const char* what) {
    const std::size_t size = 2 + prefix.size() + content.size();
    if (size > 0xffff)
        throw Refusal("cannot hold " + std::to_string(content.size() / 1024) + " KB of " + what + " in a JPEG",
                      "write a PNG or TIFF, or leave the metadata out");
    std::string segment;
    append_integer(segment, 0xff00u | unsigned(marker), 2, Endian::big);
    append_integer(segment, size, 2, Endian::big);
    return segment.append(prefix).append(content);
}

std::string png_chunk(std::string_view type, std::string_view data) {
    std::string checked(type);
    checked += data;
    std::string chunk;
    append_integer(chunk, data.size(), 4, Endian::big);
    chunk += checked;
    append_integer(chunk, crc32_z(0, reinterpret_cast<const Bytef*>(checked.data()), checked.size()), 4, Endian::big);
    return chunk;
}

/// PNG's own keywords of the four texts (PNG specification, 11.3.3.2).
std::string png_keyword(TiffTagId id) {
    switch (id) {
        case TiffTagId::artist: return "Author";
        case TiffTagId::copyright: return "Copyright";
        case TiffTagId::description: return "Description";
        case TiffTagId::software: return "Software";
        default: return "";
    }
}

std::string png_chunks(const WrittenMetadata& metadata) {
    // sRGB, and for readers that do not know it the gamma nearest to it.
    std::string gamma;
    append_integer(gamma, 45455, 4, Endian::big);
    std::string chunks = png_chunk("sRGB", std::string(1, '\0')) + png_chunk("gAMA", gamma);
    TiffDirectory directory;
    directory.tags = metadata.tags;
    if (const double dpi = directory.dpi(); dpi > 0) {
        const auto per_metre = std::uint32_t(dpi / 0.0254 + 0.5);
        std::string data;
        append_integer(data, per_metre, 4, Endian::big);
        append_integer(data, per_metre, 4, Endian::big);
        chunks += png_chunk("pHYs", data + '\1');
    }
    for (const TiffTag& tag : metadata.tags) {
        const std::string keyword = png_keyword(tag.id);
        if (keyword.empty()) continue;
        // Keyword, not compressed, no language, no translated keyword, text.
        std::string data = keyword;
        data.append(5, '\0').append(tag.value, 0, tag.value.size() - 1);
        chunks += png_chunk("iTXt", data);
    }
    if (!metadata.xmp.empty()) chunks += png_chunk("iTXt", std::string(kPngXmp) + metadata.xmp);
    return chunks;
}

ipc::Descriptor concatenated(Bytes head, std::string_view middle, Bytes tail) {
    ipc::Descriptor file = ipc::shared_memory(0);
    ipc::write_all(file, head);
    ipc::write_all(file, bytes_of(middle), head.size());
    ipc::write_all(file, tail, head.size() + middle.size());
    return file;
}

ipc::Descriptor png_with(const Bytes file, const WrittenMetadata& metadata) {
    constexpr std::size_t kBehindHeader = 8 + 12 + 13;
    return concatenated(part(file, 0, kBehindHeader), png_chunks(metadata), part(file, kBehindHeader));
}

ipc::Descriptor jpeg_with(const Bytes file, const WrittenMetadata& metadata, const std::string& icc_profile) {
    std::string ours, kept;
    if (!metadata.tags.empty()) ours += jpeg_segment(kApp1, kJpegExif, exif_block(metadata.tags), "descriptions");
    if (!metadata.xmp.empty()) ours += jpeg_segment(kApp1, kJpegXmp, metadata.xmp, "recipe");
    ours += jpeg_segment(kApp2, kJpegIcc, icc_profile, "colour profile");
    const std::size_t end = for_each_jpeg_segment(file, [&](int marker, Bytes segment) {
        if (marker == kApp1) return;  // OpenImageIO's EXIF
        (marker == kApp0 ? kept : ours) += text_of(segment);
    });
    return concatenated(part(file, 0, 2), kept + ours, part(file, end));
}

ipc::Descriptor tiff_with(ipc::Descriptor file, const Bytes bytes, const WrittenMetadata& metadata,
                          const std::string& icc_profile) {
    auto directory = first_directory(bytes);
    if (!directory || directory->endian != Endian::little || bytes.size() > 0xff000000u)
        throw Refusal("cannot be encoded (it needs more than the 4 GB of a TIFF)", "make it smaller");
    std::erase_if(directory->tags, [](const TiffTag& tag) { return tag.id == TiffTagId::date_time; });
    replace_tags(*directory, metadata.tags);
    if (!metadata.xmp.empty()) replace_tags(*directory, {bytes_tag(TiffTagId::xmp, TiffType::byte, metadata.xmp)});
    replace_tags(*directory, {bytes_tag(TiffTagId::icc_profile, TiffType::undefined, icc_profile)});
    // The old directory stays where it is, pointed to by nothing.
    const auto offset = std::uint32_t(bytes.size() + bytes.size() % 2);
    std::string header;
    append_integer(header, offset, 4, Endian::little);
    ipc::write_all(file, bytes_of(directory_bytes(*directory, offset)), offset);
    ipc::write_all(file, bytes_of(header), 4);
    return file;
}

}  // namespace

EmbeddedMetadata embedded_metadata(FileFormat format, Bytes file) {
    EmbeddedMetadata found;
    const auto take = [](std::string& block, std::string_view data, std::string_view prefix) {
        if (block.empty() && data.starts_with(prefix)) block = data.substr(prefix.size());
    };
    if (format == FileFormat::jpeg) {
        for_each_jpeg_segment(file, [&](int marker, Bytes segment) {
            if (marker != kApp1) return;
            take(found.exif, text_of(part(segment, 4)), kJpegExif);
            take(found.xmp, text_of(part(segment, 4)), kJpegXmp);
        });
    } else if (format == FileFormat::png) {
        for_each_png_chunk(file, [&](std::string_view type, Bytes data) {
            if (type == "eXIf") take(found.exif, text_of(data), "");
            if (type == "iTXt") take(found.xmp, text_of(data), kPngXmp);
        });
    } else if (format == FileFormat::tiff) {
        const auto directory = first_directory(file);
        const TiffTag* xmp = directory ? directory->find(TiffTagId::xmp) : nullptr;
        if (xmp) found.xmp = xmp->value;
    }
    return found;
}

ipc::Descriptor with_metadata(FileFormat format, ipc::Descriptor file, const WrittenMetadata& metadata,
                              const std::string& icc_profile) {
    const ipc::Mapping mapping(file, ipc::size_bytes(file), false);
    switch (format) {
        case FileFormat::png: return png_with(mapping.bytes(), metadata);
        case FileFormat::jpeg: return jpeg_with(mapping.bytes(), metadata, icc_profile);
        case FileFormat::tiff: return tiff_with(std::move(file), mapping.bytes(), metadata, icc_profile);
        default: return file;
    }
}

}  // namespace dstylize::codec
