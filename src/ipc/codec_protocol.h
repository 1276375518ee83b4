#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

// What the library and the program dstylize-codec say to each other over one channel: the codec greets
// once when it has loaded; then each Request, which passes the memory that holds its payload, is followed by one
// Answer, which passes the memory that holds its own. Both are built from the same sources and run on one machine, so
// plain structs serve. The codec reads hostile files: the library believes no number in an Answer that it has not
// checked.
namespace dstylize::ipc {

/// The channel's number in the codec, and how it is started: dstylize-codec MAX_MEMORY_BYTES.
inline constexpr int kCodecChannel = 3;
inline constexpr std::uint32_t kCodecProtocol = 2;

struct CodecGreeting {
    std::uint32_t protocol = kCodecProtocol;
};

enum class CodecOperation : std::uint32_t { decode, encode };

/// What the encoder is to make.
struct EncodeSettings {
    char format[8] = {};  ///< "png", "jpg", "tif", "webp"
    std::int32_t quality = 0, compression = 0;
};

struct CodecRequest {
    CodecOperation operation = CodecOperation::decode;
    std::uint32_t allow_damaged = 0;
    /// decode: the file. encode: width * height pixels of 4 bytes.
    std::uint64_t payload_bytes = 0;
    /// Metadata text behind the payload.
    std::uint64_t text_bytes = 0;
    std::int32_t width = 0, height = 0;
    double dpi = 0;
    EncodeSettings encode;
};

enum class CodecStatus : std::uint32_t {
    done,
    refused,  ///< problem and remedy say why
    crashed,  ///< while it worked on the request; problem says how
};

struct CodecAnswer {
    CodecStatus status = CodecStatus::refused;
    /// decode: width * height pixels of 4 bytes. encode: the file.
    std::uint64_t payload_bytes = 0;
    std::uint64_t text_bytes = 0;
    std::int32_t width = 0, height = 0;
    std::uint32_t has_alpha = 0;
    /// What the kernel holds the worker to (sandbox/confine.h), as it says itself before it meets a file.
    std::uint32_t calls_filtered = 0, files_closed = 0;
    double dpi = 0;
    /// Zero-terminated.
    char problem[400] = {}, remedy[200] = {};
};

using MetadataText = std::vector<std::pair<std::string, std::string>>;

/// Keys and values, each followed by a zero byte, in one block. A zero byte within them is left out.
std::string packed_text(const MetadataText& text);
/// The inverse; a last part without its zero byte is left out.
MetadataText unpacked_text(const std::string& block);

}  // namespace dstylize::ipc
