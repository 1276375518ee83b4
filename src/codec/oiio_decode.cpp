#include "codec/oiio_decode.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "codec/oiio_colours.h"
#include "codec/pixel_rows.h"
#include "codec/refusal.h"

namespace dstylize::codec {
namespace {

using OIIO::ImageInput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

/// What the reader complained about, as part of one line, without our name for the file. Empty when it
/// is something that harms no pixel.
std::string complaint(const ImageInput& input, const std::string& path) {
    std::string text = input.geterror();
    for (const std::string_view harmless : {"unknown JFIF revision", "before marker 0xd9"})
        if (text.find(harmless) != std::string::npos && text.find('\n') == std::string::npos) return "";
    text = text.substr(0, text.find('\n'));
    for (const std::string& noise : {fmt::format(" (\"{}\")", path), fmt::format("\"{}\"", path), path})
        for (std::size_t at; (at = text.find(noise)) != std::string::npos;) text.erase(at, noise.size());
    while (!text.empty() && (text.back() == ' ' || text.back() == '.' || text.back() == ':')) text.pop_back();
    return text.substr(0, 200);
}

/// Damage, or a kind that the reader does not know: what it says tells which.
Refusal unreadable(const std::string& complaint) {
    for (const std::string_view sign : {"upport", "not implemented", "exceeds \"limits"})
        if (complaint.find(sign) != std::string::npos)
            return Refusal(fmt::format("is of a kind that is not read ({})", complaint), "convert it to PNG or JPEG",
                           true);
    return damaged(complaint);
}

class Reader {
  public:
    Reader(FileFormat format, const ipc::Descriptor& file)
        : format_(format), path_("/proc/self/fd/" + std::to_string(file.number())) {
        ImageSpec config;
        config["oiio:UnassociatedAlpha"] = 1;
        open(config);
        const std::string colours = spec_.get_string_attribute("tiff:ColorSpace");
        if (colours == "CMYK" || colours == "CIELAB") {
            config["oiio:RawColor"] = 1;  // keeps them as they are; we convert them better
            open(config);
        }
    }

    const ImageSpec& spec() const { return spec_; }
    std::string complaint() const { return codec::complaint(*input_, path_); }

    /// Rows that are read at best speed together.
    int rows_at_once(std::size_t row_bytes) const {
        if (spec_.tile_width) return spec_.tile_height;
        constexpr std::size_t kBytes = 8u << 20;
        const int rows = int(std::clamp<std::size_t>(kBytes / std::max<std::size_t>(row_bytes, 1), 1, 64));
        const int strip = spec_.get_int_attribute("tiff:RowsPerStrip", 1);
        return strip > 1 && strip <= rows ? rows / strip * strip : rows;
    }

    bool read(int row, int rows, const TypeDesc& type, void* samples) {
        const int begin = spec_.y + row, end = begin + rows;
        if (spec_.tile_width)
            return input_->read_tiles(0, 0, spec_.x, spec_.x + spec_.width, begin, end, spec_.z, spec_.z + 1, 0,
                                      spec_.nchannels, type, samples);
        return input_->read_scanlines(0, 0, begin, end, spec_.z, 0, spec_.nchannels, type, samples);
    }

  private:
    void open(const ImageSpec& config) {
        input_ = ImageInput::create(reader_name(format_), false);
        if (!input_) throw Refusal(std::string("is ") + reader_name(format_) + ", which this OpenImageIO lacks", "");
        ImageSpec opened;
        if (!input_->open(path_, opened, config)) throw unreadable(complaint());
        spec_ = input_->spec();
    }
    FileFormat format_;
    std::string path_;
    std::unique_ptr<ImageInput> input_;
    ImageSpec spec_;
};

/// The part of the plane that is the picture, and where the stored pixels lie in it.
struct Window {
    Extent extent;
    int x = 0, y = 0;
    bool filled = true;  ///< the stored pixels cover it
};

/// OpenEXR stores any part of the plane beside the part to be shown, the display window; with all other
/// formats the two are one.
Window window_of(FileFormat format, const ImageSpec& spec) {
    if (format != FileFormat::exr) return {{spec.width, spec.height}};
    Window window{{spec.full_width, spec.full_height}, spec.x - spec.full_x, spec.y - spec.full_y};
    window.filled = window.x <= 0 && window.y <= 0 && window.x + spec.width >= spec.full_width &&
                    window.y + spec.height >= spec.full_height;
    return window;
}

/// A tile is held in memory for every row of tiles, whatever part of it lies in the picture.
void check_tiles(const ImageSpec& spec) {
    constexpr std::uint64_t kAlwaysFine = 4096 * 4096;
    const auto tile = std::uint64_t(std::max(spec.tile_width, 0)) * std::uint64_t(std::max(spec.tile_height, 0));
    const auto picture = std::uint64_t(spec.width) * std::uint64_t(spec.height);
    if (tile > kAlwaysFine && tile / 4 > picture) throw damaged("its tiles are impossibly large");
}

/// Reads row by row into the sink. False when damage ended it early; throws Refusal unless that is allowed.
bool read_all_rows(Reader& reader, const SampleLayout& layout, const PixelConverter& converter, const Window& window,
                   bool allow_damaged, PictureSink& sink) {
    const ImageSpec& spec = reader.spec();
    const TypeDesc type = layout.type == SampleType::uint8    ? TypeDesc::UINT8
                          : layout.type == SampleType::uint16 ? TypeDesc::UINT16
                                                              : TypeDesc::FLOAT;
    const auto width = std::size_t(spec.width);
    const std::size_t row_bytes = layout.pixel_bytes() * width;
    // Where damage is allowed, rows are read one by one, so that all before the damage are kept.
    const int rows_at_once = allow_damaged && !spec.tile_width ? 1 : reader.rows_at_once(row_bytes);
    std::vector<std::byte> samples(row_bytes * std::size_t(rows_at_once));
    std::vector<Rgba8> pixels(width * std::size_t(rows_at_once));
    for (int row = 0; row < spec.height; row += rows_at_once) {
        const int rows = std::min(rows_at_once, spec.height - row);
        const bool good = reader.read(row, rows, type, samples.data());
        const std::string complaint = reader.complaint();
        if ((!good || !complaint.empty()) && !allow_damaged) throw unreadable(complaint);
        if (!good && row == 0) throw unreadable(complaint);
        if (!good) return false;
        const auto read = std::span(pixels).first(width * std::size_t(rows));
        converter.convert(samples.data(), read);
        sink.place_part(read, spec.width, window.x, window.y + row);
    }
    return true;
}

}  // namespace

Decoded oiio_decoded(FileFormat format, const ipc::Descriptor& file, const EmbeddedMetadata& embedded,
                     const std::optional<TiffDirectory>& exif, const Limits& limits) {
    TiffColours tiff;
    if (format == FileFormat::tiff && exif) tiff = taken_over_colours(file, *exif);
    Reader reader(format, file);
    const ImageSpec& spec = reader.spec();
    const Window window = window_of(format, spec);
    check_size({spec.width, spec.height}, 0, limits);
    check_size(window.extent, 0, limits);
    if (spec.depth > 1) throw Refusal("is a volume, not a picture", "give a flat picture");
    check_tiles(spec);
    const SampleLayout layout = sample_layout(format, spec, tiff);
    const PixelConverter converter(layout, stated_transform(format, layout, spec));
    PictureSink sink(window.extent, stored_orientation(format, spec, exif));
    const bool whole = read_all_rows(reader, layout, converter, window, limits.allow_damaged, sink);

    Decoded decoded;
    decoded.extent = sink.upright().extent();
    const auto transparent = [](Rgba8 p) { return p.a != 255; };
    decoded.has_alpha = !whole || !window.filled || (layout.alpha >= 0 && format != FileFormat::gif) ||
                        (format == FileFormat::gif && std::ranges::any_of(sink.pixels(), transparent));
    decoded.pixels = sink.take();
    decoded.dpi = carried_dpi(spec, exif);
    decoded.text = carried_text(spec, embedded.xmp);
    return decoded;
}

}  // namespace dstylize::codec
