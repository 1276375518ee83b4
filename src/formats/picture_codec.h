#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/picture.h"

namespace dstylize {

class CodecProcess;

/// What is carried from an input to an output besides pixels.
struct PictureMetadata {
    double dpi = 0;  ///< pixels per inch; 0: not stated
    /// "author", "copyright", "description", "software" in UTF-8, and "recipe": how a drawing was made.
    /// Other keys (letters and digits) are carried too.
    std::vector<std::pair<std::string, std::string>> text;

    /// The first text of that key, or nothing.
    std::string find(const std::string& key) const;
};

/// What the kernel held the process to that decoded; limits on memory it had in any case.
struct DecoderConfinement {
    bool system_calls = false;  ///< no network, no new file or process
    bool files = false;         ///< no file of others either
};

/// A picture file's content: upright, 8-bit sRGB, straight alpha.
struct DecodedPicture {
    Picture picture;
    bool has_alpha = false;  ///< the file states transparency, whether or not any pixel uses it
    PictureMetadata metadata;
    DecoderConfinement confinement;
};

struct CodecOptions {
    /// The program dstylize-codec. Empty: looked for beside this program's binary, then in
    /// ../libexec/dstylize/ as seen from there, then likewise as seen from this library.
    std::filesystem::path program;
    std::uint64_t max_memory_bytes = 4ull << 30;  ///< of the codec; larger pictures are refused
    double timeout_s = 120;                       ///< of one picture
    bool allow_damaged = false;                   ///< take what can be read of a damaged file
};

struct EncodeOptions {
    std::string format = "png";  ///< "png", "jpg", "tif" or "webp"
    int quality = 92;            ///< jpg, webp: 1 to 100; webp 100 is lossless
    int compression = 1;         ///< png, tif: 0 to 9, more is smaller and much slower
    PictureMetadata metadata;
};

/// Decodes and encodes pictures in a child process with limits on memory and time, because decoders of
/// hostile or damaged files crash and hang. The child is started by the constructor, which does not wait
/// for it, and renewed after it died; a batch keeps one PictureCodec. For one thread at a time.
///
/// In: PNG, JPEG, TIFF, WebP, BMP, GIF (first frame), PNM, OpenEXR, Radiance HDR, recognised by content.
/// Embedded profiles are converted to sRGB, EXIF orientation is applied, floats are taken as linear.
class PictureCodec {
  public:
    /// Throws Error(failed) when the program cannot be found or started.
    explicit PictureCodec(CodecOptions options = {});
    ~PictureCodec();
    PictureCodec(PictureCodec&&) noexcept;
    PictureCodec& operator=(PictureCodec&&) noexcept;

    /// `name` is the file's name for messages. Throws Error(cannot_read): damaged, unsupported, over the
    /// limits; Error(failed) when the codec itself does not run.
    DecodedPicture decode(std::span<const std::byte> file_bytes, const std::string& name);

    /// The bytes of a picture file, tagged as sRGB. JPEG has no alpha: it is dropped, flatten it before.
    /// A picture without transparency is written without alpha. Throws Error(cannot_write).
    std::vector<std::byte> encode(const Picture& picture, const EncodeOptions& options, const std::string& name);

  private:
    CodecOptions options_;
    std::unique_ptr<CodecProcess> process_;
};

}  // namespace dstylize
