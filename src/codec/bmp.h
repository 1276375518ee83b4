#pragma once
#include <optional>

#include "codec/decode.h"

namespace dstylize::codec {

/// Windows bitmaps of 16 and 32 bits per pixel, whose channels lie where masks say; nothing for all other
/// bitmaps. (OpenImageIO 2.4 ignores the masks, and takes the unused byte of 32-bit pixels for alpha,
/// which makes most such files invisible.)
std::optional<Decoded> masked_bmp_decoded(Bytes file, const Limits& limits);

}  // namespace dstylize::codec
