#include "codec/decode.h"

#include <OpenImageIO/tiffutils.h>

#include <algorithm>
#include <string>
#include <vector>

#include "codec/bmp.h"
#include "codec/cmyk_jpeg.h"
#include "codec/file_format.h"
#include "codec/oiio_decode.h"
#include "codec/refusal.h"
#include "codec/webp.h"

namespace dstylize::codec {

void check_size(Extent stored, std::uint64_t extra_pixel_bytes, const Limits& limits) {
    if (stored.x < 1 || stored.y < 1) throw Refusal("has no pixels", "give a picture with pixels");
    const std::uint64_t pixel_bytes = 2 * sizeof(Rgba8) + extra_pixel_bytes;
    if (stored.count() > limits.max_memory_bytes / pixel_bytes)
        throw Refusal("is " + std::to_string(stored.x) + " x " + std::to_string(stored.y) +
                          " pixels, too large for the memory limit of " +
                          std::to_string(limits.max_memory_bytes >> 20) + " MB",
                      "raise --max-memory or make it smaller");
}

PictureSink::PictureSink(Extent stored, int orientation)
    : stored_(stored),
      upright_(stored, orientation),
      memory_(ipc::shared_memory(stored.count() * sizeof(Rgba8))),
      mapping_(memory_, stored.count() * sizeof(Rgba8), true) {}

std::span<Rgba8> PictureSink::pixels() const {
    return {reinterpret_cast<Rgba8*>(mapping_.bytes().data()), mapping_.bytes().size() / sizeof(Rgba8)};
}

void PictureSink::place_part(std::span<const Rgba8> rows, int width, int x, int y) {
    if (x == 0 && width == stored_.x && y >= 0 && y + int(rows.size()) / width <= stored_.y) return place(rows, y);
    std::vector<Rgba8> row(std::size_t(stored_.x), Rgba8{0, 0, 0, 0});
    const int first = std::max(x, 0);
    const std::int64_t end = std::min<std::int64_t>(std::int64_t(x) + width, stored_.x);
    for (; !rows.empty(); rows = rows.subspan(std::size_t(width)), ++y) {
        if (y < 0 || y >= stored_.y || end <= first) continue;
        std::copy_n(rows.begin() + (first - x), end - first, row.begin() + first);
        place(row, y);
    }
}

void carry(const EmbeddedMetadata& embedded, const std::optional<TiffDirectory>& exif, Decoded& decoded) {
    OIIO::ImageSpec spec;
    if (exif) OIIO::decode_exif(embedded.exif, spec);
    decoded.dpi = carried_dpi(spec, exif);
    decoded.text = carried_text(spec, embedded.xmp);
}

Decoded decoded(Bytes bytes, const ipc::Descriptor& file, const Limits& limits) {
    const FileFormat format = recognised_format(bytes);
    if (const auto extent = declared_extent(format, bytes)) check_size(*extent, 0, limits);
    if (format == FileFormat::webp) return webp_decoded(bytes, limits);
    if (format == FileFormat::bmp)
        if (auto bitmap = masked_bmp_decoded(bytes, limits)) return std::move(*bitmap);
    const EmbeddedMetadata embedded = embedded_metadata(format, bytes);
    const auto exif = first_directory(format == FileFormat::tiff ? bytes : bytes_of(embedded.exif));
    if (format == FileFormat::jpeg && is_cmyk_jpeg(bytes)) return cmyk_jpeg_decoded(bytes, embedded, exif, limits);
    return oiio_decoded(format, file, embedded, exif, limits);
}

}  // namespace dstylize::codec
