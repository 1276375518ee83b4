#pragma once
#include <string>

#include "codec/file_format.h"
#include "codec/metadata.h"
#include "ipc/descriptor.h"

namespace dstylize::codec {

/// Blocks of metadata as they lie in a file, without the container's prefixes; empty where there are none.
struct EmbeddedMetadata {
    std::string exif;  ///< begins with a TIFF header
    std::string xmp;
};

/// The blocks of a PNG or JPEG, and the XMP of a TIFF (the whole of which is an EXIF block). WebP's come
/// from its own library. Safe on hostile bytes.
EmbeddedMetadata embedded_metadata(FileFormat format, Bytes file);

/// The PNG, JPEG or TIFF file in memory `file` as written by OpenImageIO, with our metadata in place of
/// what it wrote, and the profile where pixels are not tagged by other means. The result may be the same
/// memory. Throws Refusal when a block is longer than the format allows.
ipc::Descriptor with_metadata(FileFormat format, ipc::Descriptor file, const WrittenMetadata& metadata,
                              const std::string& icc_profile);

}  // namespace dstylize::codec
