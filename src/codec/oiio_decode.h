#pragma once
#include "codec/container.h"
#include "codec/decode.h"
#include "codec/file_format.h"

namespace dstylize::codec {

/// Reads any format but WebP through OpenImageIO, from a file descriptor. `embedded` is what the file
/// holds besides pixels; for TIFF its EXIF is the file itself.
Decoded oiio_decoded(FileFormat format, const ipc::Descriptor& file, const EmbeddedMetadata& embedded,
                     const std::optional<TiffDirectory>& exif, const Limits& limits);

}  // namespace dstylize::codec
