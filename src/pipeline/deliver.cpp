#include "pipeline/deliver.h"

#include <algorithm>

#include "formats/document.h"
#include "formats/skeleton.h"
#include "imaging/filters.h"
#include "pipeline/lit_ground.h"
#include "render/raster.h"

namespace dstylize {
namespace {

constexpr std::size_t kMostGrainedPixels = 4'000'000;
constexpr int kMostGroundPixels = 4096;  // of the long side of a picture inside a vector file

std::vector<std::byte> bytes_of(const std::string& text) {
    const auto* first = reinterpret_cast<const std::byte*>(text.data());
    return {first, first + text.size()};
}

bool is_opaque(const Picture& picture) {
    return std::all_of(picture.begin(), picture.end(), [](Rgba8 p) { return p.a == 255; });
}

Picture over_white(Picture picture) {
    for (Rgba8& p : picture) {
        const auto over = [a = int(p.a)](int c) { return std::uint8_t((c * a + 255 * (255 - a) + 127) / 255); };
        p = {over(p.r), over(p.g), over(p.b), 255};
    }
    return picture;
}

/// Pages are in mm only when somebody asked for a size: a picture pixel is 1/96 inch otherwise.
void set_page(DocumentInfo& info, const OutputFrame& frame, Extent picture) {
    constexpr double kMmPerPixel = 25.4 / 96;
    info.width_mm = frame.width_mm;
    info.height_mm = frame.height_mm;
    if (frame.width_mm > 0 || frame.size_px == picture) return;
    info.width_mm = frame.size_px.x * kMmPerPixel;
    info.height_mm = frame.size_px.y * kMmPerPixel;
}

}  // namespace

int most_pixels(FormatId format) {
    switch (format) {
        case FormatId::webp: return 16383;
        case FormatId::jpg: return 65500;
        default: return 65535;
    }
}

std::vector<std::byte> picture_file(const Picture& picture, const OutputFormat& format, const DeliveryOptions& options,
                                    PictureCodec& codec, const std::string& name) {
    EncodeOptions encode;
    encode.format = format.name;
    encode.quality = options.quality;
    encode.compression = options.compression;
    encode.metadata = options.metadata;
    if (options.frame.dpi > 0) encode.metadata.dpi = options.frame.dpi;
    if (!format.alpha && !is_opaque(picture)) return codec.encode(over_white(picture), encode, name);
    return codec.encode(picture, encode, name);
}

Delivery::Delivery(Drawing drawing, DeliveryOptions options, PictureCodec& codec)
    : drawing_(std::move(drawing)), options_(std::move(options)), codec_(codec) {
    if (options_.frame.size_px.count() > kMostGrainedPixels) drawing_.list.paper.grain = 0;
}

std::vector<std::byte> Delivery::file(const OutputFormat& format, const std::string& name, const Work& work) {
    return format.holds == Holds::picture ? picture_file(format, name, work) : document_file(format, name, work);
}

std::vector<std::byte> Delivery::picture_file(const OutputFormat& format, const std::string& name, const Work& work) {
    if (!raster_) {
        const auto ground = drawing_.list.paper.picture;
        if (ground) drawing_.list.paper.picture = std::make_shared<Picture>(resized(*ground, options_.frame.size_px));
        raster_ = raster(drawing_.list, {options_.frame.size_px}, work);
        drawing_.list.paper.picture = ground;
    }
    return dstylize::picture_file(*raster_, format, options_, codec_, name);
}

std::vector<std::byte> Delivery::document_file(const OutputFormat& format, const std::string& name, const Work& work) {
    DocumentInfo info;
    info.title = options_.title;
    info.text = options_.metadata.text;
    const Extent frame{int(drawing_.list.width_px), int(drawing_.list.height_px)};
    set_page(info, options_.frame, frame);
    if (format.holds == Holds::skeleton) {
        return bytes_of(skeleton_json(
            {drawing_.dendrite, drawing_.lattice, drawing_.picture, drawing_.stage_names, drawing_.width_u}, info));
    }
    const DisplayList list = with_lit_ground(drawing_.list, kMostGroundPixels, work);
    if (format.id == FormatId::pdf) return bytes_of(pdf_document(list, info));
    if (list.paper.picture) info.paper_png = codec_.encode(*list.paper.picture, {}, name);
    if (list.cover) info.cover_png = codec_.encode(*list.cover, {}, name);
    return bytes_of(svg_document(list, info));
}

}  // namespace dstylize
