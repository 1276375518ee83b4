#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "formats/picture_codec.h"

// Picture files of every kind that the codec has to read, put together byte by byte, so that no library
// that the codec itself uses vouches for it.
namespace dstylize::test {

using FileBytes = std::vector<std::byte>;

FileBytes file_of(std::string_view text);
std::string text_of(const FileBytes& file);

/// Little- and big-endian numbers of 1, 2 or 4 bytes.
std::string le(std::uint64_t value, int size);
std::string be(std::uint64_t value, int size);
std::string float_le(float value);

/// An EXIF block that states an orientation, little-endian ("II") or big-endian ("MM").
std::string exif_with_orientation(int orientation, std::string_view byte_order = "II");

// --- PNG ---
std::string png_chunk(std::string_view type, std::string_view data);
/// zlib's format with stored blocks.
std::string stored_zlib(std::string_view data);
struct PngHeader {
    std::uint32_t width = 1, height = 1;
    int depth = 8;
    int colour_type = 2;  ///< 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGBA
};
/// `rows` are the bytes of all rows without filter bytes; `chunks` stand before the picture data.
FileBytes png_file(const PngHeader& header, std::string_view rows, std::string_view chunks = "");
/// The file with chunks put behind its header.
FileBytes png_with_chunks(const FileBytes& png, std::string_view chunks);

// --- JPEG, WebP: blocks put into files that the codec encoded ---
FileBytes jpeg_with_exif(const FileBytes& jpeg, std::string_view exif);
FileBytes jpeg_with_profile(const FileBytes& jpeg, std::string_view icc_profile);
/// A JPEG of four inks, flat blocks of 8 x 8 pixels in a row; each sample comes back exactly. With Adobe's marker,
/// samples mean 255 - ink.
FileBytes cmyk_jpeg_file(const std::vector<std::array<int, 4>>& blocks, bool adobe);
/// The chunk takes the place of the one of its name, which must be there.
FileBytes webp_with_chunk(const FileBytes& webp, std::string_view name, std::string_view content);

// --- TIFF ---
struct TiffTagBytes {
    int id, type;
    std::uint32_t count;
    std::string value;
};
TiffTagBytes tiff_short(int id, const std::vector<int>& values);
TiffTagBytes tiff_long(int id, std::uint32_t value);
struct TiffKind {
    int width = 1, height = 1, samples = 3, bits = 8;
    int photometric = 2;    ///< 0 white is zero, 1 black is zero, 2 RGB, 3 palette, 5 CMYK, 8 CIELAB
    int sample_format = 1;  ///< 1 unsigned, 3 float
    int extra_sample = -1;  ///< of the last: 0 unspecified, 1 associated alpha, 2 unassociated alpha
};
/// An uncompressed little-endian file of one strip.
FileBytes tiff_file(const TiffKind& kind, std::string_view samples, std::vector<TiffTagBytes> tags = {});

// --- others ---
/// One part, scan lines, no compression, channels of floats in the order of their names.
struct ExrKind {
    int data[4] = {0, 0, 0, 0};     ///< x and y of the first and the last stored pixel
    int display[4] = {0, 0, 0, 0};  ///< the same of the pixels to be shown
    std::vector<std::string> channels;
    std::string attributes;  ///< further header attributes, as they lie in the file
};
/// `samples`: for each row, for each channel, the row's floats.
FileBytes exr_file(const ExrKind& kind, const std::vector<float>& samples);
std::string exr_attribute(std::string_view name, std::string_view type, std::string_view value);
/// Flat pixels of 4 bytes: red, green, blue mantissas and exponent.
FileBytes hdr_file(int width, int height, std::string_view rgbe);
/// A Windows bitmap of 32 bits per pixel with masks of red, green, blue and alpha (0: no alpha).
FileBytes bmp_file(int width, int height, const std::vector<std::uint32_t>& masks, std::string_view rows);
/// Indices below 4 into a palette of 4 colours; `transparent` is one of them, or -1.
FileBytes gif_file(int width, int height, const std::vector<Rgba8>& palette, const std::vector<int>& indices,
                   int transparent);

// --- colour profiles ---
/// RGB with primaries in CIE XYZ adapted to D50 and one gamma.
std::string rgb_profile(const double (&red)[3], const double (&green)[3], const double (&blue)[3], double gamma);
/// Display P3's primaries with a gamma of 2.2.
std::string p3_profile();
std::string grey_profile(double gamma);
/// Four inks that all print the colours of `paper` and `ink` (CIE L*a*b*): any black ink gives `ink`.
std::string cmyk_profile(const double (&paper)[3], const double (&ink)[3]);

}  // namespace dstylize::test
