#include "codec/cmyk_jpeg.h"

#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

// After <cstdio>, which it needs.
#include <jpeglib.h>

#include "codec/pixel_rows.h"
#include "codec/refusal.h"

namespace dstylize::codec {
namespace {

/// libjpeg's way of failing: a jump to where setjmp was called. Functions that call setjmp hold no
/// objects with destructors across it.
struct ErrorManager {
    jpeg_error_mgr base;
    std::jmp_buf failed;
};

[[noreturn]] void jump_out(j_common_ptr info) { std::longjmp(reinterpret_cast<ErrorManager*>(info->err)->failed, 1); }
void stay_silent(j_common_ptr) {}

class CmykReader {
  public:
    /// Delegates, so that what libjpeg has taken is given back when this throws.
    explicit CmykReader(Bytes file) : CmykReader() {
        info_.err = jpeg_std_error(&errors_.base);
        errors_.base.error_exit = jump_out;
        errors_.base.output_message = stay_silent;
        if (!opened(file)) throw_damaged();
    }
    CmykReader(const CmykReader&) = delete;
    CmykReader& operator=(const CmykReader&) = delete;
    ~CmykReader() { jpeg_destroy_decompress(&info_); }

    Extent extent() const { return {int(info_.output_width), int(info_.output_height)}; }
    bool inverted() const { return info_.saw_Adobe_marker; }  // Adobe stores 255 - ink
    bool warned() const { return errors_.base.num_warnings > 0; }
    std::string icc_profile() {
        JOCTET* bytes = nullptr;
        unsigned size = 0;
        if (setjmp(errors_.failed)) throw_damaged();
        if (!jpeg_read_icc_profile(&info_, &bytes, &size)) return "";
        std::string profile(reinterpret_cast<const char*>(bytes), size);
        std::free(bytes);
        return profile;
    }
    bool read_row(std::uint8_t* inks) {
        if (setjmp(errors_.failed)) return false;
        JSAMPROW row = inks;
        return jpeg_read_scanlines(&info_, &row, 1) == 1;
    }
    [[noreturn]] void throw_damaged() {
        char text[JMSG_LENGTH_MAX] = {};
        errors_.base.format_message(reinterpret_cast<j_common_ptr>(&info_), text);
        throw damaged(text);
    }

  private:
    CmykReader() = default;
    bool opened(Bytes file) {
        if (setjmp(errors_.failed)) return false;
        jpeg_create_decompress(&info_);
        jpeg_mem_src(&info_, reinterpret_cast<const unsigned char*>(file.data()), file.size());
        jpeg_save_markers(&info_, JPEG_APP0 + 2, 0xffff);
        jpeg_read_header(&info_, TRUE);
        info_.out_color_space = JCS_CMYK;
        return jpeg_start_decompress(&info_);
    }
    jpeg_decompress_struct info_{};
    ErrorManager errors_{};
};

std::optional<ProfileTransform> ink_transform(const std::string& profile) try {
    if (!is_profile_for(bytes_of(profile), 4)) return std::nullopt;
    return ProfileTransform(bytes_of(profile), 4, SampleType::uint8);
} catch (const Refusal&) {  // a broken profile counts as none
    return std::nullopt;
}

}  // namespace

bool is_cmyk_jpeg(Bytes file) { return jpeg_components(file) == 4; }

Decoded cmyk_jpeg_decoded(Bytes file, const EmbeddedMetadata& embedded, const std::optional<TiffDirectory>& exif,
                          const Limits& limits) {
    CmykReader reader(file);
    check_size(reader.extent(), 0, limits);
    SampleLayout layout;
    layout.channels = layout.colours = 4;
    layout.inverted = reader.inverted();
    const PixelConverter converter(layout, ink_transform(reader.icc_profile()));
    PictureSink sink(reader.extent(), exif ? int(exif->integer(TiffTagId::orientation).value_or(1)) : 1);
    std::vector<Rgba8> row(std::size_t(reader.extent().x));
    std::vector<std::uint8_t> inks(row.size() * 4);
    bool whole = true;
    for (int j = 0; j < reader.extent().y && whole; ++j) {
        whole = reader.read_row(inks.data());
        if ((!whole || reader.warned()) && !limits.allow_damaged) reader.throw_damaged();
        if (!whole) break;
        converter.convert(inks.data(), row);
        sink.place(row, j);
    }
    Decoded decoded;
    decoded.extent = sink.upright().extent();
    decoded.has_alpha = !whole;
    decoded.pixels = sink.take();
    carry(embedded, exif, decoded);
    return decoded;
}

}  // namespace dstylize::codec
