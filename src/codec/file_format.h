#pragma once
#include <optional>

#include "codec/byte_reader.h"
#include "core/grid.h"

namespace dstylize::codec {

enum class FileFormat { png, jpeg, tiff, webp, bmp, gif, pnm, exr, hdr };

/// The format that the first bytes state, whatever the file is called. Throws Refusal for any other,
/// naming it where it is a well-known one.
FileFormat recognised_format(Bytes file);

/// The number of components that a JPEG's frame header declares; 0 when none is found.
int jpeg_components(Bytes file);

/// OpenImageIO's name of the format.
const char* reader_name(FileFormat format);

/// The size that the header declares, where it is quickly found (PNG, JPEG, GIF, BMP): some decoders
/// allocate as soon as a file is opened.
std::optional<Extent> declared_extent(FileFormat format, Bytes file);

}  // namespace dstylize::codec
