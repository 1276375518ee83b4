// Decodes and encodes pictures for dstylize, one request after the other, over the channel that the program was
// started with. It alone loads OpenImageIO, which takes long, and then works in a forked child (supervisor.h),
// which alone touches hostile bytes. It ends when the channel closes.
#include "codec/module.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <new>
#include <string>

#include "codec/decode.h"
#include "codec/encode.h"
#include "codec/refusal.h"
#include "codec/supervisor.h"
#include "ipc/channel.h"
#include "ipc/codec_protocol.h"
#include "ipc/shared_memory.h"
#include "sandbox/confine.h"

namespace {

using namespace dstylize;

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

ipc::CodecAnswer refusal_of(const std::string& problem, const std::string& remedy) {
    ipc::CodecAnswer answer;
    answer.status = ipc::CodecStatus::refused;
    problem.copy(answer.problem, sizeof(answer.problem) - 1);
    remedy.copy(answer.remedy, sizeof(answer.remedy) - 1);
    return answer;
}

/// Whether this process may go on after what it has seen.
enum class Trust { kept, lost };

Trust answer_request(const ipc::CodecRequest& request, const ipc::Descriptor& payload, std::uint64_t max_memory_bytes,
                     ipc::CodecAnswer& answer, ipc::Descriptor& result) {
    try {
        answer.status = ipc::CodecStatus::done;
        result = request.operation == ipc::CodecOperation::decode ? decode(request, payload, max_memory_bytes, answer)
                                                                  : encode(request, payload, answer);
        return Trust::kept;
    } catch (const codec::Refusal& refusal) {
        answer = refusal_of(refusal.what(), refusal.remedy);
        return refusal.harmful ? Trust::lost : Trust::kept;
    } catch (const std::bad_alloc&) {
        answer = refusal_of(fmt::format("needs more memory than the limit of {} MB", max_memory_bytes >> 20),
                            "raise --max-memory or make it smaller");
    } catch (const std::exception& error) {
        answer = refusal_of(fmt::format("is damaged ({})", error.what()), "export it again");
    }
    return Trust::lost;
}

/// The worker: answers requests until the channel closes or it has met damage. `busy` tells the others.
codec::WorkerEnd serve(const ipc::Descriptor& channel, std::uint64_t max_memory_bytes, std::atomic<bool>& busy,
                       sandbox::Confinement held) {
    OIIO::attribute("threads", 2);
    OIIO::attribute("exr_threads", 2);
    while (true) {
        ipc::CodecRequest request;
        ipc::CodecAnswer answer;
        ipc::Descriptor payload, result;
        if (ipc::receive_struct(channel, request, payload) != ipc::Arrival::message)
            return codec::WorkerEnd::channel_closed;
        busy = true;
        const Trust trust = answer_request(request, payload, max_memory_bytes, answer, result);
        answer.calls_filtered = held.system_calls;
        answer.files_closed = held.files;
        busy = false;
        if (!ipc::send_struct(channel, answer, result.number())) return codec::WorkerEnd::channel_closed;
        if (trust == Trust::lost) return codec::WorkerEnd::retired;
    }
}

}  // namespace

int dstylize_codec(std::uint64_t max_memory_bytes) {
    const ipc::Descriptor channel(ipc::kCodecChannel);
    sandbox::limit_resources(max_memory_bytes);
    if (!ipc::send_struct(channel, ipc::CodecGreeting{})) return 1;
    codec::supervise(channel, [&](std::atomic<bool>& busy, sandbox::Confinement held) {
        return serve(channel, max_memory_bytes, busy, held);
    });
    _exit(0);  // without the libraries' farewells, which take a tenth of a second
}
