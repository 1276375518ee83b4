#include "codec/decode.h"

#include <string>

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
    : upright_(stored, orientation),
      memory_(ipc::shared_memory(stored.count() * sizeof(Rgba8))),
      mapping_(memory_, stored.count() * sizeof(Rgba8), true) {}

std::span<Rgba8> PictureSink::pixels() const {
    return {reinterpret_cast<Rgba8*>(mapping_.bytes().data()), mapping_.bytes().size() / sizeof(Rgba8)};
}

Decoded decoded(Bytes bytes, const ipc::Descriptor& file, const Limits& limits) {
    const FileFormat format = recognised_format(bytes);
    if (const auto extent = declared_extent(format, bytes)) check_size(*extent, 0, limits);
    if (format == FileFormat::webp) return webp_decoded(bytes, limits);
    const EmbeddedMetadata embedded = embedded_metadata(format, bytes);
    const auto exif = first_directory(format == FileFormat::tiff ? bytes : bytes_of(embedded.exif));
    return oiio_decoded(format, file, embedded, exif, limits);
}

}  // namespace dstylize::codec
