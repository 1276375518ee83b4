#include "codec/oiio_colours.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "codec/refusal.h"
#include "ipc/shared_memory.h"

namespace dstylize::codec {
namespace {

using OIIO::ImageSpec;
using OIIO::TypeDesc;

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

std::string profile_of(const ImageSpec& spec) {
    const OIIO::ParamValue* profile = spec.find_attribute("ICCProfile");
    if (!profile || profile->type().basetype != TypeDesc::UINT8) return "";
    return std::string(static_cast<const char*>(profile->data()), profile->type().size());
}

/// What a PNG says of its gamma, where that is not about sRGB's, or an OpenEXR of its primaries.
std::optional<StatedColours> stated_colours(FileFormat format, const ImageSpec& spec) {
    StatedColours stated;
    if (format == FileFormat::png) {
        stated.gamma = spec.get_float_attribute("oiio:Gamma");
        if (stated.gamma > 0.1 && stated.gamma < 10 && std::abs(stated.gamma - 2.2) > 0.05) return stated;
    }
    float xy[8];
    if (format == FileFormat::exr && spec.getattribute("chromaticities", TypeDesc(TypeDesc::FLOAT, 8), xy)) {
        double* const points[] = {stated.red, stated.green, stated.blue, stated.white};
        for (int n = 0; n < 8; ++n) {
            if (!(xy[n] > -1 && xy[n] < 2)) return std::nullopt;
            points[n / 2][n % 2] = xy[n];
        }
        const StatedColours rec709;
        const auto differs = [](const double(&a)[2], const double(&b)[2]) {
            return std::abs(a[0] - b[0]) > 1e-3 || std::abs(a[1] - b[1]) > 1e-3;
        };
        if (differs(stated.red, rec709.red) || differs(stated.green, rec709.green) ||
            differs(stated.blue, rec709.blue) || differs(stated.white, rec709.white))
            return stated;
    }
    return std::nullopt;
}

/// Gives a tag that lies in the file another number.
void rewrite_tag(const ipc::Descriptor& file, const TiffDirectory& directory, TiffTagId id, TiffType type,
                 std::uint32_t number) {
    const TiffTag* tag = directory.find(id);
    if (!tag) return;
    const bool is_short = type == TiffType::short_integer;
    std::string entry;
    append_integer(entry, std::uint64_t(id), 2, directory.endian);
    append_integer(entry, std::uint64_t(type), 2, directory.endian);
    append_integer(entry, 1, 4, directory.endian);
    append_integer(entry, number, is_short ? 2 : 4, directory.endian);
    if (is_short) append_integer(entry, 0, 2, directory.endian);
    ipc::write_all(file, bytes_of(entry), tag->entry_offset);
}

}  // namespace

TiffColours taken_over_colours(const ipc::Descriptor& file, const TiffDirectory& directory) {
    constexpr std::uint32_t kWhiteIsZero = 0, kBlackIsZero = 1, kPalette = 3;
    TiffColours colours;
    // Its arithmetic on more rows than there are overflows into an endless loop.
    const auto rows = directory.integer(TiffTagId::image_length);
    if (rows && directory.integer(TiffTagId::rows_per_strip).value_or(0) > *rows)
        rewrite_tag(file, directory, TiffTagId::rows_per_strip, TiffType::long_integer, *rows);
    const auto stated = directory.integer(TiffTagId::photometric);
    const bool extra_samples = directory.integer(TiffTagId::samples_per_pixel).value_or(1) > 1;
    if (stated == kWhiteIsZero) {
        colours.inverted = true;
    } else if (stated == kPalette && extra_samples) {
        const TiffTag* map = directory.find(TiffTagId::colour_map);
        if (!map || map->value.size() < 3 * 256 * 2 || directory.integer(TiffTagId::bits_per_sample) != 8u)
            throw Refusal("has a palette of an unusual kind, which is not read", "convert it to RGB");
        for (std::size_t n = 0; n < 256; ++n) {
            const auto component = [&](std::size_t c) {
                return std::uint8_t(integer_at(bytes_of(map->value), (c * 256 + n) * 2, 2, directory.endian) / 257);
            };
            colours.palette.push_back({component(0), component(1), component(2), 255});
        }
    } else {
        return colours;
    }
    rewrite_tag(file, directory, TiffTagId::photometric, TiffType::short_integer, kBlackIsZero);
    return colours;
}

SampleLayout sample_layout(FileFormat format, const ImageSpec& spec, const TiffColours& tiff) {
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
    layout.inverted = tiff.inverted;
    layout.palette = tiff.palette;
    const std::string inks = spec.get_string_attribute("tiff:ColorSpace");
    if (inks == "color separated" && spec.nchannels != 4 && spec.nchannels != 5)
        throw Refusal("uses printing inks other than cyan, magenta, yellow and black", "convert it to RGB");
    layout.lab = inks == "CIELAB" && spec.nchannels >= 3 && layout.type != SampleType::float32;
    layout.colours = inks == "CMYK" || inks == "color separated" ? 4 : spec.nchannels >= 3 ? 3 : 1;
    if (layout.colours == 4 && layout.type == SampleType::float32) layout.type = SampleType::uint16;
    // GIF's reader states a channel that does not exist.
    const int alpha = format == FileFormat::gif ? spec.nchannels - 1 : spec.alpha_channel;
    if (alpha >= layout.colours && alpha < spec.nchannels) layout.alpha = alpha;
    layout.premultiplied = format == FileFormat::tiff && !spec.get_int_attribute("tiff:UnassociatedAlpha");
    return layout;
}

std::optional<ProfileTransform> stated_transform(FileFormat format, const SampleLayout& layout, const ImageSpec& spec) {
    if (layout.lab) return ProfileTransform::from_lab();
    if (!layout.palette.empty()) return std::nullopt;
    const std::string profile = profile_of(spec);
    if (profile.empty()) {
        if (const auto stated = stated_colours(format, spec))
            return ProfileTransform(*stated, layout.colours, layout.type);
    } else if (is_profile_for(bytes_of(profile), layout.colours)) {
        try {
            ProfileTransform transform(bytes_of(profile), layout.colours, layout.type);
            if (!transform.is_identity()) return transform;
        } catch (const Refusal&) {  // a broken profile counts as none, as in every viewer
        }
    }
    return std::nullopt;
}

int stored_orientation(FileFormat format, const ImageSpec& spec, const std::optional<TiffDirectory>& exif) {
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

}  // namespace dstylize::codec
