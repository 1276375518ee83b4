#pragma once
#include <OpenImageIO/imageio.h>

#include <optional>
#include <string>

#include "codec/tiff_tags.h"
#include "ipc/codec_protocol.h"

namespace dstylize::codec {

/// `text` as it is if it is UTF-8, else taken as Latin-1; without control characters but tab and newline.
std::string as_utf8(const std::string& text);

/// The texts that are carried to the output: author, copyright, description, software as OpenImageIO read
/// them, and ours out of an XMP packet.
ipc::MetadataText carried_text(const OIIO::ImageSpec& spec, const std::string& xmp);

/// Pixels per inch, from EXIF where it states them, else as OpenImageIO read them; 0 when not stated.
double carried_dpi(const OIIO::ImageSpec& spec, const std::optional<TiffDirectory>& exif);

/// The same of a number: 0 when it is no resolution; whole numbers that a format had to round (PNG counts
/// pixels per metre) are restored.
double carried_dpi(double stated);

/// What is written into a picture besides pixels, in the two forms that containers hold.
struct WrittenMetadata {
    std::vector<TiffTag> tags;  ///< little-endian: resolution, description, artist, copyright, software
    std::string xmp;            ///< our own texts, the recipe above all; empty when there are none
};
WrittenMetadata written_metadata(const ipc::MetadataText& text, double dpi);

/// Our own texts in an XMP packet (Adobe XMP specification, part 1), or nothing when there are none.
std::string xmp_packet(const ipc::MetadataText& text);
/// Its inverse; nothing for packets of others. Safe on hostile bytes.
ipc::MetadataText own_text(const std::string& xmp);

}  // namespace dstylize::codec
