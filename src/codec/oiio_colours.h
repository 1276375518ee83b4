#pragma once
#include <OpenImageIO/imageio.h>

#include <optional>

#include "codec/file_format.h"
#include "codec/pixel_rows.h"
#include "codec/tiff_tags.h"
#include "ipc/descriptor.h"

namespace dstylize::codec {

/// How a TIFF's samples are to be understood where OpenImageIO 2.4 gets them wrong.
struct TiffColours {
    bool inverted = false;       ///< 0 is white
    std::vector<Rgba8> palette;  ///< of indices with further samples beside them
};

/// Takes such TIFFs over, and mends a number of rows per strip beyond the picture: rewrites their photometric tag in
/// `file` to "0 is black", so that OpenImageIO delivers bare samples. (It leaves 0-is-white pictures of more than 8
/// bits inverted, and reads a palette with alpha as noise.) Throws Refusal for palettes that cannot be taken over.
TiffColours taken_over_colours(const ipc::Descriptor& file, const TiffDirectory& directory);

/// What the samples mean that a reader with this spec delivers.
SampleLayout sample_layout(FileFormat format, const OIIO::ImageSpec& spec, const TiffColours& tiff);

/// The conversion to sRGB that the file asks for; nothing when it is sRGB, or linear floats.
std::optional<ProfileTransform> stated_transform(FileFormat format, const SampleLayout& layout,
                                                 const OIIO::ImageSpec& spec);

/// EXIF's orientation of the rows that the reader delivers.
int stored_orientation(FileFormat format, const OIIO::ImageSpec& spec, const std::optional<TiffDirectory>& exif);

}  // namespace dstylize::codec
