#pragma once
#include "codec/decode.h"
#include "codec/encode.h"
#include "codec/metadata.h"

namespace dstylize::codec {

/// WebP through its own library: OpenImageIO 2.4 multiplies colours by alpha in 8 bits on reading, divides
/// them on writing as if they were linear, and knows neither profiles nor orientation.
/// Of an animation, the first frame on its canvas.
Decoded webp_decoded(Bytes file, const Limits& limits);

/// `quality` 100 is lossless. Throws Refusal for sides above 16,383.
ipc::Descriptor webp_encoded(const Drawing& drawing, int quality, const WrittenMetadata& metadata,
                             const std::string& icc_profile);

}  // namespace dstylize::codec
