#include "codec/bmp.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <vector>

#include "codec/metadata.h"
#include "codec/refusal.h"

namespace dstylize::codec {
namespace {

/// One channel's bits in a pixel.
class ChannelMask {
  public:
    explicit ChannelMask(std::uint32_t mask) : mask_(mask), shift_(mask ? std::countr_zero(mask) : 0) {}
    explicit operator bool() const { return mask_ != 0; }
    std::uint8_t value(std::uint32_t pixel) const {
        const std::uint64_t most = mask_ >> shift_;
        return most ? std::uint8_t((std::uint64_t((pixel & mask_) >> shift_) * 255 + most / 2) / most) : 0;
    }

  private:
    std::uint32_t mask_;
    int shift_;
};

struct MaskedBitmap {
    Extent extent;
    bool top_down = false;
    int bytes_per_pixel = 4;
    ChannelMask red{0}, green{0}, blue{0}, alpha{0};
    std::size_t pixels_at = 0;
    double dpi = 0;
};

std::optional<MaskedBitmap> masked_bitmap(Bytes file) {
    const auto number = [&](std::size_t offset) { return std::uint32_t(integer_at(file, offset, 4, Endian::little)); };
    constexpr std::uint32_t kPlain = 0, kMasks = 3, kMasksWithAlpha = 6;
    const std::uint32_t header_bytes = number(14), compression = number(30);
    const auto bits = int(integer_at(file, 28, 2, Endian::little));
    if (header_bytes < 40 || (bits != 16 && bits != 32)) return std::nullopt;
    if (compression != kPlain && compression != kMasks && compression != kMasksWithAlpha) return std::nullopt;
    const auto width = std::int32_t(number(18)), height = std::int32_t(number(22));
    if (width <= 0 || height == 0 || height == INT32_MIN) throw damaged("its size is impossible");

    MaskedBitmap bitmap;
    bitmap.extent = {width, std::abs(height)};
    bitmap.top_down = height < 0;
    bitmap.bytes_per_pixel = bits / 8;
    bitmap.pixels_at = number(10);
    bitmap.dpi = carried_dpi(number(38) * 0.0254);
    if (compression == kPlain) {
        bitmap.red = ChannelMask(bits == 16 ? 0x7c00 : 0xff0000);
        bitmap.green = ChannelMask(bits == 16 ? 0x03e0 : 0x00ff00);
        bitmap.blue = ChannelMask(bits == 16 ? 0x001f : 0x0000ff);
    } else {
        bitmap.red = ChannelMask(number(54));
        bitmap.green = ChannelMask(number(58));
        bitmap.blue = ChannelMask(number(62));
        if (header_bytes >= 56 || compression == kMasksWithAlpha) bitmap.alpha = ChannelMask(number(66));
    }
    return bitmap;
}

}  // namespace

std::optional<Decoded> masked_bmp_decoded(Bytes file, const Limits& limits) {
    const auto bitmap = masked_bitmap(file);
    if (!bitmap) return std::nullopt;
    check_size(bitmap->extent, 0, limits);
    constexpr int kFlipped = 4;
    PictureSink sink(bitmap->extent, bitmap->top_down ? 1 : kFlipped);
    const auto bytes_per_pixel = std::size_t(bitmap->bytes_per_pixel);
    const std::size_t row_bytes = (std::size_t(bitmap->extent.x) * bytes_per_pixel + 3) / 4 * 4;
    std::vector<Rgba8> row(std::size_t(bitmap->extent.x));
    bool whole = true, any_alpha = false;
    for (int j = 0; j < bitmap->extent.y && whole; ++j) {
        const Bytes stored = part(file, bitmap->pixels_at + std::size_t(j) * row_bytes, row_bytes);
        // Some writers leave the last row's padding out.
        if (stored.size() < row.size() * bytes_per_pixel) {
            whole = false;
            break;
        }
        for (std::size_t i = 0; i < row.size(); ++i) {
            const auto pixel =
                std::uint32_t(integer_at(stored, i * bytes_per_pixel, bitmap->bytes_per_pixel, Endian::little));
            row[i] = {bitmap->red.value(pixel), bitmap->green.value(pixel), bitmap->blue.value(pixel),
                      bitmap->alpha ? bitmap->alpha.value(pixel) : std::uint8_t(255)};
            any_alpha |= row[i].a != 0;
        }
        sink.place(row, j);
    }
    if (!whole && !limits.allow_damaged) throw damaged("it ends too early");
    // Writers that know no alpha state a mask for it and leave it 0.
    if (whole && !any_alpha)
        for (Rgba8& pixel : sink.pixels()) pixel.a = 255;

    Decoded decoded;
    decoded.extent = sink.upright().extent();
    decoded.has_alpha = !whole || (bitmap->alpha && any_alpha);
    decoded.dpi = bitmap->dpi;
    decoded.pixels = sink.take();
    return decoded;
}

}  // namespace dstylize::codec
