#pragma once
#include "codec/container.h"
#include "codec/decode.h"

namespace dstylize::codec {

bool is_cmyk_jpeg(Bytes file);

/// JPEGs of four inks through libjpeg, with their own profile: OpenImageIO 2.4 has turned the inks into
/// RGB before a profile could tell what they look like.
Decoded cmyk_jpeg_decoded(Bytes file, const EmbeddedMetadata& embedded, const std::optional<TiffDirectory>& exif,
                          const Limits& limits);

}  // namespace dstylize::codec
