#include "codec/webp.h"

#include <webp/decode.h>
#include <webp/demux.h>
#include <webp/encode.h>
#include <webp/mux.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "codec/pixel_rows.h"
#include "codec/refusal.h"
#include "ipc/shared_memory.h"

namespace dstylize::codec {
namespace {

using Demuxer = std::unique_ptr<WebPDemuxer, decltype(&WebPDemuxDelete)>;
using Muxer = std::unique_ptr<WebPMux, decltype(&WebPMuxDelete)>;

WebPData data_of(Bytes bytes) { return {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}; }
WebPData data_of(const std::string& text) { return data_of(bytes_of(text)); }

std::string chunk(const WebPDemuxer* demuxer, const char (&name)[5]) {
    WebPChunkIterator found;
    if (!WebPDemuxGetChunk(demuxer, name, 1, &found)) return "";
    std::string content(reinterpret_cast<const char*>(found.chunk.bytes), found.chunk.size);
    WebPDemuxReleaseChunkIterator(&found);
    return content;
}

struct FirstFrame {
    WebPIterator frame{};
    explicit FirstFrame(const WebPDemuxer* demuxer) {
        if (!WebPDemuxGetFrame(demuxer, 1, &frame)) throw damaged("no frame");
    }
    FirstFrame(const FirstFrame&) = delete;
    FirstFrame& operator=(const FirstFrame&) = delete;
    ~FirstFrame() { WebPDemuxReleaseIterator(&frame); }
};

/// Decodes the frame into its place on the canvas. False when only a part of it could be read.
bool draw_frame(const WebPIterator& frame, Extent canvas, std::span<Rgba8> pixels) {
    WebPDecoderConfig config;
    if (!WebPInitDecoderConfig(&config)) throw damaged("");
    const std::size_t first = std::size_t(frame.y_offset) * std::size_t(canvas.x) + std::size_t(frame.x_offset);
    config.options.use_threads = 1;
    config.output.colorspace = MODE_RGBA;
    config.output.is_external_memory = 1;
    config.output.u.RGBA.rgba = reinterpret_cast<std::uint8_t*>(pixels.data() + first);
    config.output.u.RGBA.stride = canvas.x * int(sizeof(Rgba8));
    config.output.u.RGBA.size = (pixels.size() - first) * sizeof(Rgba8);
    WebPIDecoder* decoder = WebPIDecode(nullptr, 0, &config);
    if (!decoder) throw std::bad_alloc();
    const VP8StatusCode status = WebPIUpdate(decoder, frame.fragment.bytes, frame.fragment.size);
    WebPIDelete(decoder);
    if (status == VP8_STATUS_OUT_OF_MEMORY) throw std::bad_alloc();
    return status == VP8_STATUS_OK;
}

void convert_colours(std::span<Rgba8> pixels, const std::string& icc_profile) {
    SampleLayout layout;
    layout.channels = 4;
    layout.alpha = 3;
    if (!is_profile_for(bytes_of(icc_profile), 3)) return;
    try {
        ProfileTransform transform(bytes_of(icc_profile), 3, layout.type);
        if (transform.is_identity()) return;
        PixelConverter(layout, std::move(transform)).convert(pixels.data(), pixels);
    } catch (const Refusal&) {  // a broken profile counts as none, as in every viewer
    }
}

}  // namespace

Decoded webp_decoded(Bytes file, const Limits& limits) {
    WebPDemuxState state{};
    const WebPData data = data_of(file);
    const Demuxer demuxer(WebPDemuxPartial(&data, &state), &WebPDemuxDelete);
    if (!demuxer || state == WEBP_DEMUX_PARSE_ERROR) throw damaged("its structure is broken");
    if (state != WEBP_DEMUX_DONE && !limits.allow_damaged) throw damaged("it ends too early");
    const Extent canvas{int(WebPDemuxGetI(demuxer.get(), WEBP_FF_CANVAS_WIDTH)),
                        int(WebPDemuxGetI(demuxer.get(), WEBP_FF_CANVAS_HEIGHT))};
    check_size(canvas, sizeof(Rgba8), limits);
    const FirstFrame first(demuxer.get());
    const WebPIterator& frame = first.frame;
    if (frame.x_offset + frame.width > canvas.x || frame.y_offset + frame.height > canvas.y)
        throw damaged("a frame exceeds the canvas");

    EmbeddedMetadata embedded{chunk(demuxer.get(), "EXIF"), chunk(demuxer.get(), "XMP ")};
    if (embedded.exif.starts_with("Exif")) embedded.exif.erase(0, 6);  // some writers keep JPEG's prefix
    const auto exif = first_directory(bytes_of(embedded.exif));
    const int orientation = exif ? int(exif->integer(TiffTagId::orientation).value_or(1)) : 1;

    PictureSink sink(canvas, orientation);
    std::vector<Rgba8> stored;
    std::span<Rgba8> pixels = sink.pixels();
    if (orientation > 1 && orientation <= 8) {
        stored.assign(canvas.count(), Rgba8{0, 0, 0, 0});
        pixels = stored;
    }
    const bool whole = draw_frame(frame, canvas, pixels);
    if (!whole && !limits.allow_damaged) throw damaged("its picture data is broken");
    convert_colours(pixels, chunk(demuxer.get(), "ICCP"));
    if (!stored.empty()) sink.place(stored, 0);

    Decoded decoded;
    decoded.extent = sink.upright().extent();
    const bool covered = frame.width == canvas.x && frame.height == canvas.y;
    decoded.has_alpha = frame.has_alpha || !covered || !whole;
    decoded.pixels = sink.take();
    carry(embedded, exif, decoded);
    return decoded;
}

ipc::Descriptor webp_encoded(const Drawing& drawing, int quality, const WrittenMetadata& metadata,
                             const std::string& icc_profile) {
    if (drawing.extent.long_side() > WEBP_MAX_DIMENSION)
        throw Refusal("cannot be a WebP, whose sides end at " + std::to_string(WEBP_MAX_DIMENSION) + " pixels",
                      "write a PNG, or make it smaller");
    WebPConfig config;
    WebPPicture picture;
    if (!WebPConfigInit(&config) || !WebPPictureInit(&picture)) throw Refusal("cannot be encoded (libwebp)", "");
    const std::unique_ptr<WebPPicture, decltype(&WebPPictureFree)> freed(&picture, &WebPPictureFree);
    WebPMemoryWriter written;
    WebPMemoryWriterInit(&written);
    const std::unique_ptr<WebPMemoryWriter, decltype(&WebPMemoryWriterClear)> cleared(&written, &WebPMemoryWriterClear);

    config.lossless = quality >= 100;
    config.quality = config.lossless ? 20 : float(std::clamp(quality, 1, 99));  // lossless: the effort
    config.method = config.lossless ? 1 : 2;
    config.exact = config.lossless;  // also the colours where alpha is 0
    config.thread_level = 1;
    picture.use_argb = config.lossless;
    picture.width = drawing.extent.x;
    picture.height = drawing.extent.y;
    picture.writer = WebPMemoryWrite;
    picture.custom_ptr = &written;
    const auto* rgba = reinterpret_cast<const std::uint8_t*>(drawing.pixels.data());
    const int stride = drawing.extent.x * int(sizeof(Rgba8));
    if (!WebPPictureImportRGBA(&picture, rgba, stride)) throw std::bad_alloc();
    if (!WebPEncode(&config, &picture)) {
        if (picture.error_code == VP8_ENC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
        throw Refusal("cannot be encoded (libwebp error " + std::to_string(picture.error_code) + ")", "", true);
    }

    const Muxer muxer(WebPMuxNew(), &WebPMuxDelete);
    const WebPData image{written.mem, written.size};
    const std::string exif = metadata.tags.empty() ? "" : exif_block(metadata.tags);
    bool good = muxer && WebPMuxSetImage(muxer.get(), &image, 0) == WEBP_MUX_OK;
    const auto add = [&](const char* name, const std::string& content) {
        const WebPData data = data_of(content);
        if (!content.empty()) good = good && WebPMuxSetChunk(muxer.get(), name, &data, 0) == WEBP_MUX_OK;
    };
    add("ICCP", icc_profile);
    add("EXIF", exif);
    add("XMP ", metadata.xmp);
    WebPData assembled{};
    good = good && WebPMuxAssemble(muxer.get(), &assembled) == WEBP_MUX_OK;
    const std::unique_ptr<WebPData, decltype(&WebPDataClear)> released(&assembled, &WebPDataClear);
    if (!good) throw Refusal("cannot be encoded (libwebpmux)", "", true);
    ipc::Descriptor file = ipc::shared_memory(0);
    ipc::write_all(file, std::as_bytes(std::span(assembled.bytes, assembled.size)));
    return file;
}

}  // namespace dstylize::codec
