// What the codec reads of a picture file itself, before and instead of OpenImageIO: containers, TIFF and EXIF tags,
// metadata, bitmaps with masks, WebP, CMYK JPEG. Any bytes are a picture, nothing, or a Refusal.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>

#include "codec/bmp.h"
#include "codec/cmyk_jpeg.h"
#include "codec/container.h"
#include "codec/file_format.h"
#include "codec/metadata.h"
#include "codec/refusal.h"
#include "codec/tiff_tags.h"
#include "codec/webp.h"
#include "law.h"

namespace {

using namespace dstylize;
using namespace dstylize::codec;

constexpr Limits kLimits{64u << 20, false};

void read(Bytes bytes) {
    const FileFormat format = recognised_format(bytes);
    if (const auto extent = declared_extent(format, bytes)) law(extent->x >= 0 && extent->y >= 0, "no negative sides");
    const EmbeddedMetadata embedded = embedded_metadata(format, bytes);
    law(embedded.exif.size() <= 2 * bytes.size() + (64u << 20), "metadata stays small");
    const auto exif = first_directory(format == FileFormat::tiff ? bytes : bytes_of(embedded.exif));
    own_text(embedded.xmp);
    std::optional<Decoded> decoded;
    if (format == FileFormat::webp) decoded = webp_decoded(bytes, kLimits);
    if (format == FileFormat::bmp) decoded = masked_bmp_decoded(bytes, kLimits);
    if (format == FileFormat::jpeg && is_cmyk_jpeg(bytes)) decoded = cmyk_jpeg_decoded(bytes, embedded, exif, kLimits);
    if (!decoded) return;
    law(decoded->extent.x > 0 && decoded->extent.y > 0, "a picture has pixels");
    law(ipc::size_bytes(decoded->pixels) == decoded->extent.count() * sizeof(Rgba8), "all pixels are there");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        read({reinterpret_cast<const std::byte*>(data), size});
    } catch (const Refusal&) {
    } catch (const std::exception&) {  // the codec answers these too (module.cpp)
    }
    return 0;
}
