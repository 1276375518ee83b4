// dstylize-codec decodes and encodes pictures for dstylize, one request after the other, over the channel
// that it is started with. It alone loads OpenImageIO, and it alone touches hostile bytes: it may crash
// or hang, and is then ended and replaced. It ends when the channel closes.
#include <OpenImageIO/imageio.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <new>
#include <string>
#include <string_view>
#include <thread>

#include "codec/decode.h"
#include "codec/encode.h"
#include "codec/refusal.h"
#include "ipc/channel.h"
#include "ipc/codec_protocol.h"
#include "ipc/shared_memory.h"

namespace {

using namespace dstylize;

/// Address space in use, in bytes.
std::uint64_t address_space_bytes() {
    unsigned long long pages = 0;
    if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
        if (std::fscanf(file, "%llu", &pages) != 1) pages = 0;
        std::fclose(file);
    }
    return pages * std::uint64_t(sysconf(_SC_PAGESIZE));
}

/// Limits this process: no core dumps, and `max_memory_bytes` more address space than it has loaded.
void limit_resources(std::uint64_t max_memory_bytes) {
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    prctl(PR_SET_DUMPABLE, 0);
    const std::uint64_t loaded = address_space_bytes();
    if (max_memory_bytes > RLIM_INFINITY - loaded) return;
    const rlimit space{loaded + max_memory_bytes, loaded + max_memory_bytes};
    setrlimit(RLIMIT_AS, &space);
}

/// Ends this process as soon as the other end of the channel is gone, however busy or stuck it is. (The
/// kernel's parent-death signal would also come when merely the thread that started us ends.)
void end_with(const ipc::Descriptor& channel) {
    std::thread([number = channel.number()] {
        pollfd hangup{number, 0, 0};
        while (poll(&hangup, 1, -1) < 0) continue;
        _exit(0);
    }).detach();
}

void refuse(ipc::CodecAnswer& answer, const std::string& problem, const std::string& remedy, bool retires) {
    answer = {};
    answer.status = ipc::CodecStatus::refused;
    answer.retires = retires;
    problem.copy(answer.problem, sizeof(answer.problem) - 1);
    remedy.copy(answer.remedy, sizeof(answer.remedy) - 1);
}

ipc::Descriptor decode(const ipc::CodecRequest& request, const ipc::Descriptor& file, std::uint64_t max_memory_bytes,
                       ipc::CodecAnswer& answer) {
    const ipc::Mapping bytes(file, request.payload_bytes, false);
    codec::Decoded picture = codec::decoded(bytes.bytes(), file, {max_memory_bytes, request.allow_damaged != 0});
    const std::string text = ipc::packed_text(picture.text);
    answer.width = picture.extent.x;
    answer.height = picture.extent.y;
    answer.has_alpha = picture.has_alpha;
    answer.dpi = picture.dpi;
    answer.payload_bytes = picture.extent.count() * sizeof(Rgba8);
    answer.text_bytes = text.size();
    ipc::write_all(picture.pixels, std::as_bytes(std::span(text)), answer.payload_bytes);
    return std::move(picture.pixels);
}

ipc::Descriptor encode(const ipc::CodecRequest& request, const ipc::Descriptor& payload, ipc::CodecAnswer& answer) {
    const ipc::Mapping mapping(payload, request.payload_bytes + request.text_bytes, false);
    const auto text = mapping.bytes().subspan(request.payload_bytes);
    codec::Drawing drawing;
    drawing.extent = {request.width, request.height};
    drawing.pixels = {reinterpret_cast<const Rgba8*>(mapping.bytes().data()), drawing.extent.count()};
    drawing.dpi = request.dpi;
    drawing.text = ipc::unpacked_text(std::string(reinterpret_cast<const char*>(text.data()), text.size()));
    ipc::Descriptor file = codec::encoded(drawing, request.encode);
    answer.payload_bytes = ipc::size_bytes(file);
    return file;
}

/// Answers one request. False when the channel is gone or this process must not go on.
bool serve(const ipc::Descriptor& channel, std::uint64_t max_memory_bytes) {
    ipc::CodecRequest request;
    ipc::CodecAnswer answer;
    ipc::Descriptor payload, result;
    if (ipc::receive_struct(channel, request, payload) != ipc::Arrival::message) return false;
    answer.status = ipc::CodecStatus::done;
    try {
        result = request.operation == ipc::CodecOperation::decode ? decode(request, payload, max_memory_bytes, answer)
                                                                  : encode(request, payload, answer);
    } catch (const codec::Refusal& refusal) {
        refuse(answer, refusal.what(), refusal.remedy, refusal.harmful);
    } catch (const std::bad_alloc&) {
        refuse(answer, "needs more memory than the limit of " + std::to_string(max_memory_bytes >> 20) + " MB",
               "raise --max-memory or make it smaller", true);
    } catch (const std::exception& error) {
        refuse(answer, std::string("is damaged (") + error.what() + ")", "export it again", true);
    }
    return ipc::send_struct(channel, answer, result.number()) && !answer.retires;
}

}  // namespace

int main(int argument_count, char** arguments) {
    std::uint64_t max_memory_bytes = 0;
    const std::string_view limit = argument_count == 2 ? arguments[1] : "";
    if (std::from_chars(limit.data(), limit.data() + limit.size(), max_memory_bytes).ec != std::errc()) {
        std::fputs("dstylize-codec: is started by dstylize to decode and encode pictures\n", stderr);
        return 2;
    }
    const ipc::Descriptor channel(ipc::kCodecChannel);
    OIIO::attribute("threads", 2);
    OIIO::attribute("exr_threads", 2);
    limit_resources(max_memory_bytes);
    end_with(channel);
    if (!ipc::send_struct(channel, ipc::CodecGreeting{})) return 1;
    while (serve(channel, max_memory_bytes)) continue;
    // No destructors: after a hostile file they could crash or hang.
    _exit(0);
}
