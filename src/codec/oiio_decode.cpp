#include "codec/oiio_decode.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "codec/pixel_rows.h"
#include "codec/refusal.h"

namespace dstylize::codec {
namespace {

using OIIO::ImageInput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

/// What the reader complained about, as part of one line, without our name for the file.
std::string complaint(const ImageInput& input, const std::string& path) {
    std::string text = input.geterror();
    for (const std::string& noise : {"\"" + path + "\"", path, std::string("OpenImageIO: ")})
        for (std::size_t at; (at = text.find(noise)) != std::string::npos;) text.erase(at, noise.size());
    text = text.substr(0, text.find('\n'));
    while (!text.empty() && (text.back() == ' ' || text.back() == '(' || text.back() == '.')) text.pop_back();
    return text.substr(0, 200);
}

class Reader {
  public:
    Reader(FileFormat format, const ipc::Descriptor& file)
        : format_(format), path_("/proc/self/fd/" + std::to_string(file.number())) {
        ImageSpec config;
        config["oiio:UnassociatedAlpha"] = 1;
        open(config);
        if (spec_.get_string_attribute("tiff:ColorSpace") == "CMYK") {
            config["oiio:RawColor"] = 1;  // keeps the inks, for their profile
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

    bool read(int row, int rows, TypeDesc type, void* samples) {
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
        if (!input_->open(path_, opened, config)) throw damaged(complaint());
        spec_ = input_->spec();
    }
    FileFormat format_;
    std::string path_;
    std::unique_ptr<ImageInput> input_;
    ImageSpec spec_;
};

int channel_named(const ImageSpec& spec, const std::string& name) {
    const auto found = std::find(spec.channelnames.begin(), spec.channelnames.end(), name);
    return found == spec.channelnames.end() ? -1 : int(found - spec.channelnames.begin());
}

/// OpenEXR names its channels, possibly by layer ("beauty.R"): the first layer that has R, G and B counts,
/// else a luminance, else the first channel.
void find_exr_colours(const ImageSpec& spec, SampleLayout& layout) {
    if (channel_named(spec, "RY") >= 0)
        throw Refusal("holds luminance and chroma channels, which are not read", "convert it to RGB");
    for (const std::string& name : spec.channelnames) {
        const std::size_t dot = name.rfind('.');
        const std::string layer = dot == std::string::npos ? "" : name.substr(0, dot + 1);
        const int r = channel_named(spec, layer + "R"), g = channel_named(spec, layer + "G"),
                  b = channel_named(spec, layer + "B");
        if (r < 0 || g < 0 || b < 0) continue;
        layout.colours = 3;
        layout.colour[0] = r, layout.colour[1] = g, layout.colour[2] = b;
        layout.alpha = channel_named(spec, layer + "A");
        return;
    }
    const int y = channel_named(spec, "Y");
    layout.colours = 1;
    layout.colour[0] = y >= 0 ? y : spec.alpha_channel == 0 && spec.nchannels > 1 ? 1 : 0;
    layout.alpha = spec.nchannels > 1 ? spec.alpha_channel : -1;
}

SampleLayout layout_of(FileFormat format, const ImageSpec& spec) {
    SampleLayout layout;
    layout.channels = spec.nchannels;
    if (spec.format.is_floating_point())
        layout.type = SampleType::float32;
    else
        layout.type = spec.format.size() == 1 ? SampleType::uint8 : SampleType::uint16;
    if (format == FileFormat::exr) {
        find_exr_colours(spec, layout);
        layout.premultiplied = true;
        return layout;
    }
    const std::string inks = spec.get_string_attribute("tiff:ColorSpace");
    if (inks == "color separated" && spec.nchannels != 4 && spec.nchannels != 5)
        throw Refusal("uses printing inks other than cyan, magenta, yellow and black", "convert it to RGB");
    layout.colours = inks == "CMYK" || inks == "color separated" ? 4 : spec.nchannels >= 3 ? 3 : 1;
    if (layout.colours == 4 && layout.type == SampleType::float32) layout.type = SampleType::uint16;
    // GIF's reader states a channel that does not exist.
    const int alpha = format == FileFormat::gif ? spec.nchannels - 1 : spec.alpha_channel;
    if (alpha >= layout.colours && alpha < spec.nchannels) layout.alpha = alpha;
    layout.premultiplied = format == FileFormat::tiff && !spec.get_int_attribute("tiff:UnassociatedAlpha");
    return layout;
}

std::string profile_of(const ImageSpec& spec) {
    const OIIO::ParamValue* profile = spec.find_attribute("ICCProfile");
    if (!profile || profile->type().basetype != TypeDesc::UINT8) return "";
    return std::string(static_cast<const char*>(profile->data()), profile->type().size());
}

/// A gamma that a PNG states without a profile, where it is not about that of sRGB; else 0.
double stated_gamma(FileFormat format, const ImageSpec& spec) {
    const double gamma = format == FileFormat::png ? spec.get_float_attribute("oiio:Gamma") : 0;
    return gamma > 0.1 && gamma < 10 && std::abs(gamma - 2.2) > 0.05 ? gamma : 0;
}

std::optional<ProfileTransform> transform_for(FileFormat format, const SampleLayout& layout, const ImageSpec& spec) {
    const std::string profile = profile_of(spec);
    if (profile.empty()) {
        if (const double gamma = stated_gamma(format, spec))
            return ProfileTransform(gamma, layout.colours, layout.type);
    } else if (is_profile_for(bytes_of(profile), layout.colours)) {
        try {
            ProfileTransform transform(bytes_of(profile), layout.colours, layout.type);
            if (!transform.is_identity()) return transform;
        } catch (const Refusal&) {  // a broken profile counts as none, as in every viewer
        }
    }
    return std::nullopt;
}

/// EXIF's orientation of the rows that the reader delivers.
int orientation_of(FileFormat format, const ImageSpec& spec, const std::optional<TiffDirectory>& exif) {
    const int read = spec.get_int_attribute("Orientation", 1);
    if (format == FileFormat::hdr || (format == FileFormat::tiff && !exif)) return read;
    if (!exif) return 1;
    const int stated = int(exif->integer(TiffTagId::orientation).value_or(1));
    // Some kinds of TIFF are read through libtiff's TIFFReadRGBAImageOriented, which mirrors them already
    // and leaves only the transposition.
    const int photometric = int(exif->integer(TiffTagId::photometric).value_or(2));
    const int compression = int(exif->integer(TiffTagId::compression).value_or(1));
    const bool jpeg = compression == 6 || compression == 7;
    const bool luminance_chroma = photometric == 6 || (photometric >= 8 && photometric <= 10) || photometric >= 32844;
    const bool mirrored = format == FileFormat::tiff && !spec.tile_width &&
                          (luminance_chroma || (jpeg && exif->integer(TiffTagId::samples_per_pixel) != 3u));
    if (!mirrored) return stated;
    return stated >= 5 && stated <= 8 ? 5 : 1;
}

}  // namespace

Decoded oiio_decoded(FileFormat format, const ipc::Descriptor& file, const EmbeddedMetadata& embedded,
                     const std::optional<TiffDirectory>& exif, const Limits& limits) {
    Reader reader(format, file);
    const ImageSpec& spec = reader.spec();
    const Extent stored{spec.width, spec.height};
    check_size(stored, 0, limits);
    if (spec.depth > 1) throw Refusal("is a volume, not a picture", "give a flat picture");
    const SampleLayout layout = layout_of(format, spec);
    const PixelConverter converter(layout, transform_for(format, layout, spec));
    PictureSink sink(stored, orientation_of(format, spec, exif));

    const TypeDesc type = layout.type == SampleType::uint8    ? TypeDesc::UINT8
                          : layout.type == SampleType::uint16 ? TypeDesc::UINT16
                                                              : TypeDesc::FLOAT;
    const std::size_t row_bytes = layout.pixel_bytes() * std::size_t(stored.x);
    // Where damage is allowed, rows are read one by one, so that all before the damage are kept.
    const int rows_at_once = limits.allow_damaged && !spec.tile_width ? 1 : reader.rows_at_once(row_bytes);
    std::vector<std::byte> samples(row_bytes * std::size_t(rows_at_once));
    std::vector<Rgba8> pixels(std::size_t(stored.x) * std::size_t(rows_at_once));
    bool whole = true;
    for (int row = 0; row < stored.y && whole; row += rows_at_once) {
        const int rows = std::min(rows_at_once, stored.y - row);
        const std::size_t count = std::size_t(rows) * std::size_t(stored.x);
        whole = reader.read(row, rows, type, samples.data());
        const std::string complaint = reader.complaint();
        if ((!whole || !complaint.empty()) && !limits.allow_damaged) throw damaged(complaint);
        if (!whole && row == 0) throw damaged(complaint);
        if (!whole) break;
        converter.convert(samples.data(), std::span(pixels).first(count));
        sink.place(std::span(pixels).first(count), row);
    }

    Decoded decoded;
    decoded.extent = sink.upright().extent();
    const auto transparent = [](Rgba8 p) { return p.a != 255; };
    decoded.has_alpha =
        !whole || (layout.alpha >= 0 && (format != FileFormat::gif || std::ranges::any_of(sink.pixels(), transparent)));
    decoded.pixels = sink.take();
    decoded.dpi = carried_dpi(spec, exif);
    decoded.text = carried_text(spec, embedded.xmp);
    return decoded;
}

}  // namespace dstylize::codec
