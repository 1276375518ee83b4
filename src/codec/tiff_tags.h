#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "codec/byte_reader.h"

namespace dstylize::codec {

/// Numbers of the TIFF 6.0 and EXIF tags that are used.
enum class TiffTagId : std::uint16_t {
    image_length = 257,
    bits_per_sample = 258,
    compression = 259,
    photometric = 262,
    description = 270,
    orientation = 274,
    samples_per_pixel = 277,
    rows_per_strip = 278,
    x_resolution = 282,
    y_resolution = 283,
    resolution_unit = 296,
    software = 305,
    date_time = 306,
    artist = 315,
    colour_map = 320,
    xmp = 700,
    copyright = 33432,
    icc_profile = 34675,
};

enum class TiffType : std::uint16_t {
    byte = 1,
    ascii = 2,
    short_integer = 3,
    long_integer = 4,
    rational = 5,
    undefined = 7
};

/// One entry of a directory; `value` is as it lies in the file.
struct TiffTag {
    TiffTagId id;
    TiffType type;
    std::uint32_t count;
    std::string value;
    std::size_t entry_offset = 0;  ///< where its 12 bytes lie in the file that it was read from
};

/// A directory of tags (IFD) of a classic TIFF file or an EXIF block, which is the same thing.
struct TiffDirectory {
    Endian endian = Endian::little;
    std::vector<TiffTag> tags;

    const TiffTag* find(TiffTagId id) const;
    /// The first value of a byte, short or long tag.
    std::optional<std::uint32_t> integer(TiffTagId id) const;
    /// Pixels per inch; 0 when not stated.
    double dpi() const;
};

/// The first directory; nothing when `tiff` is no classic TIFF or has a broken one. Safe on hostile bytes.
std::optional<TiffDirectory> first_directory(Bytes tiff);

TiffTag ascii_tag(TiffTagId id, const std::string& text);
TiffTag bytes_tag(TiffTagId id, TiffType type, const std::string& bytes);
/// The three tags that state a resolution, little-endian.
std::vector<TiffTag> resolution_tags(double dpi);

/// Adds or replaces tags.
void replace_tags(TiffDirectory& directory, const std::vector<TiffTag>& tags);

/// The directory and the values that its tags point to, to be put at byte `offset` (even) of a file.
std::string directory_bytes(const TiffDirectory& directory, std::uint32_t offset);

/// An EXIF block of these little-endian tags, without a container's prefix.
std::string exif_block(const std::vector<TiffTag>& tags);

}  // namespace dstylize::codec
