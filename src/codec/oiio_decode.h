#pragma once
#include "codec/decode.h"
#include "codec/file_format.h"

namespace dstylize::codec {

/// What the metadata outside OpenImageIO's reach says about the pixels.
struct PixelHints {
    int orientation = 0;  ///< EXIF's; 0: what OpenImageIO says
    std::string icc_profile;
    double gamma = 0;  ///< values = light ^ (1 / gamma); 0: not stated
};

/// Reads the pixels of any format but WebP through OpenImageIO, from a file descriptor.
Decoded oiio_decoded(FileFormat format, const ipc::Descriptor& file, const PixelHints& hints, const Limits& limits);

}  // namespace dstylize::codec
