#include "formats/picture_codec.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <system_error>

#include "core/error.h"
#include "formats/codec_process.h"
#include "ipc/codec_protocol.h"
#include "ipc/shared_memory.h"

namespace dstylize {
namespace {

static_assert(sizeof(Rgba8) == 4, "pixels travel as they lie in a Picture");
constexpr std::uint64_t kMaxTextBytes = 64u << 20;

struct Reply {
    ipc::CodecAnswer answer;
    ipc::Descriptor payload;
};

/// A zero-terminated text of the codec as one line of ASCII, which it is not trusted to have sent.
template <std::size_t N>
std::string line(const char (&text)[N]) {
    std::string s(text, strnlen(text, N));
    std::replace_if(
        s.begin(), s.end(), [](char c) { return c < 0x20 || c > 0x7e; }, '?');
    return s;
}

std::span<std::byte> bytes_of(Picture& picture) {
    return {reinterpret_cast<std::byte*>(picture.data()), picture.size() * sizeof(Rgba8)};
}
std::span<const std::byte> bytes_of(const Picture& picture) {
    return {reinterpret_cast<const std::byte*>(picture.data()), picture.size() * sizeof(Rgba8)};
}
std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

std::string crash_text(bool reading, const std::string& how) {
    return fmt::format("the {} crashed{} ({})", reading ? "decoder" : "encoder", reading ? " on it" : "", how);
}

/// Sends one request to the process, starting it when there is none. Errors about the picture are of
/// `code` and name `file`; the process is renewed when it is gone or stuck.
Reply reply(const CodecOptions& options, std::unique_ptr<CodecProcess>& process, const ipc::CodecRequest& request,
            const ipc::Descriptor& payload, ErrorCode code, const std::string& file) {
    const bool reading = code == ErrorCode::cannot_read;
    const std::string remedy = reading ? "the file is damaged or hostile; export it again" : "try another format";
    const auto renew = [&] {
        process.reset();
        process = std::make_unique<CodecProcess>(options.program, options.max_memory_bytes);
    };
    if (!process) renew();
    Reply reply;
    using Outcome = CodecProcess::Outcome;
    const auto ask = [&] { return process->ask(request, payload, reply.answer, reply.payload, options.timeout_s); };
    Outcome outcome = ask();
    if (outcome == Outcome::was_dead) {  // no fault of this picture
        renew();
        outcome = ask();
    }
    switch (outcome) {
        case Outcome::answered: break;
        case Outcome::was_dead:
        case Outcome::died: {
            const std::string how = process->cause_of_death();
            renew();
            throw Error(code, file, crash_text(reading, how), remedy);
        }
        case Outcome::timed_out:
            renew();
            throw Error(code, file,
                        fmt::format("{} took longer than {} s", reading ? "decoding" : "encoding", options.timeout_s),
                        "the file may be damaged; allow more time for a very large one");
    }
    switch (reply.answer.status) {
        case ipc::CodecStatus::done: return reply;
        case ipc::CodecStatus::crashed:
            throw Error(code, file, crash_text(reading, line(reply.answer.problem)), remedy);
        default: throw Error(code, file, line(reply.answer.problem), line(reply.answer.remedy));
    }
}

[[noreturn]] void implausible(std::unique_ptr<CodecProcess>& process, ErrorCode code, const std::string& file) {
    process.reset();
    throw Error(code, file, "the picture codec gave a wrong answer", "the file is damaged or hostile");
}

[[noreturn]] void out_of_resources(const std::system_error& error, const std::string& file) {
    throw Error(ErrorCode::failed, file, std::string("the system refused (") + error.what() + ")",
                "free memory or close programs");
}

}  // namespace

std::string PictureMetadata::find(const std::string& key) const {
    const auto found = std::find_if(text.begin(), text.end(), [&](const auto& entry) { return entry.first == key; });
    return found == text.end() ? "" : found->second;
}

PictureCodec::PictureCodec(CodecOptions options) : options_(std::move(options)) {
    options_.program = codec_program(options_.program);
    process_ = std::make_unique<CodecProcess>(options_.program, options_.max_memory_bytes);
}
PictureCodec::~PictureCodec() = default;
PictureCodec::PictureCodec(PictureCodec&&) noexcept = default;
PictureCodec& PictureCodec::operator=(PictureCodec&&) noexcept = default;

DecodedPicture PictureCodec::decode(std::span<const std::byte> file_bytes, const std::string& name) try {
    constexpr ErrorCode kCode = ErrorCode::cannot_read;
    if (file_bytes.empty()) throw Error(kCode, name, "is empty", "give a picture");
    ipc::Descriptor file = ipc::shared_memory(file_bytes.size());
    ipc::write_all(file, file_bytes);
    ipc::CodecRequest request;
    request.operation = ipc::CodecOperation::decode;
    request.allow_damaged = options_.allow_damaged;
    request.payload_bytes = file_bytes.size();
    const auto [answer, payload] = reply(options_, process_, request, file, kCode, name);
    file.reset();

    const Extent extent{answer.width, answer.height};
    if (extent.x < 1 || extent.y < 1 || answer.payload_bytes != extent.count() * sizeof(Rgba8) ||
        answer.payload_bytes > options_.max_memory_bytes || answer.text_bytes > kMaxTextBytes ||
        ipc::size_bytes(payload) != answer.payload_bytes + answer.text_bytes)
        implausible(process_, kCode, name);
    DecodedPicture decoded{
        Picture(extent), answer.has_alpha != 0, {}, {answer.calls_filtered != 0, answer.files_closed != 0}};
    ipc::drain(payload, bytes_of(decoded.picture));
    std::string text(answer.text_bytes, '\0');
    ipc::read_all(payload, std::as_writable_bytes(std::span(text)), answer.payload_bytes);
    decoded.metadata.text = ipc::unpacked_text(text);
    if (std::isfinite(answer.dpi) && answer.dpi > 0) decoded.metadata.dpi = answer.dpi;
    return decoded;
} catch (const std::system_error& error) {
    out_of_resources(error, name);
}

std::vector<std::byte> PictureCodec::encode(const Picture& picture, const EncodeOptions& options,
                                            const std::string& name) try {
    constexpr ErrorCode kCode = ErrorCode::cannot_write;
    assert(!picture.empty() && picture.extent().z == 1);
    const std::string text = ipc::packed_text(options.metadata.text);
    ipc::CodecRequest request;
    request.operation = ipc::CodecOperation::encode;
    request.payload_bytes = picture.size() * sizeof(Rgba8);
    request.text_bytes = text.size();
    request.width = picture.extent().x;
    request.height = picture.extent().y;
    request.dpi = options.metadata.dpi;
    options.format.copy(request.encode.format, sizeof(request.encode.format) - 1);
    request.encode.quality = options.quality;
    request.encode.compression = options.compression;
    ipc::Descriptor pixels = ipc::shared_memory(request.payload_bytes + request.text_bytes);
    ipc::write_all(pixels, bytes_of(picture));
    ipc::write_all(pixels, bytes_of(text), request.payload_bytes);
    const auto [answer, payload] = reply(options_, process_, request, pixels, kCode, name);
    pixels.reset();

    if (answer.payload_bytes == 0 || ipc::size_bytes(payload) != answer.payload_bytes ||
        answer.payload_bytes > 2 * request.payload_bytes + request.text_bytes + (64u << 20))
        implausible(process_, kCode, name);
    std::vector<std::byte> file(answer.payload_bytes);
    ipc::drain(payload, file);
    return file;
} catch (const std::system_error& error) {
    out_of_resources(error, name);
}

}  // namespace dstylize
