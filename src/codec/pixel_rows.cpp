#include "codec/pixel_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace dstylize::codec {
namespace {

/// 8-bit sRGB codes of linear light, rounded exactly, without a power per sample.
class SrgbCodes {
  public:
    SrgbCodes() {
        for (int code = 1; code < 256; ++code) least_[std::size_t(code)] = linear((code - 0.5) / 255);
        least_[256] = 2;
        int code = 0;
        for (std::size_t bucket = 0; bucket < start_.size(); ++bucket) {
            while (least_[std::size_t(code) + 1] <= float(bucket) / kBuckets) ++code;
            start_[bucket] = std::uint8_t(code);
        }
    }
    /// `light` in [0, 1].
    std::uint8_t operator()(float light) const {
        int code = start_[std::size_t(light * kBuckets)];
        while (light >= least_[std::size_t(code) + 1]) ++code;
        return std::uint8_t(code);
    }

  private:
    static float linear(double encoded) {
        return float(encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4));
    }
    static constexpr int kBuckets = 4096;
    std::array<float, 257> least_{};  ///< the least light that has this code
    std::array<std::uint8_t, kBuckets + 1> start_{};
};

/// Clamped to [0, 1]; NaN gives 0.
float unit(float value) { return value >= 1 ? 1.0f : value > 0 ? value : 0.0f; }

std::uint8_t alpha8(std::uint8_t a) { return a; }
std::uint8_t alpha8(std::uint16_t a) { return std::uint8_t((a * 255u + 32767u) / 65535u); }
std::uint8_t alpha8(float a) { return std::uint8_t(unit(a) * 255 + 0.5f); }

std::uint8_t colour8(std::uint8_t c) { return c; }
std::uint8_t colour8(std::uint16_t c) { return alpha8(c); }
std::uint8_t colour8(float c) {
    static const SrgbCodes codes;
    return codes(unit(c));
}

template <class T>
T straight(T colour, T alpha) {
    if constexpr (std::is_same_v<T, float>) {
        return alpha > 0 ? colour / alpha : 0.0f;
    } else {
        constexpr std::uint32_t kMax = T(-1);
        return alpha ? T(std::min(kMax, (colour * kMax + alpha / 2u) / alpha)) : T(0);
    }
}

template <class T>
constexpr T white() {
    if constexpr (std::is_same_v<T, float>) return 1;
    return T(-1);
}

template <class T>
float ink(T value) {
    if constexpr (std::is_same_v<T, float>) return unit(value);
    return float(value) / float(T(-1));
}

/// TIFF 6.0, section 23: L* from 0 to 100 over the whole range, a* and b* as signed numbers.
template <class T>
std::array<float, 3> lab(const T* colour) {
    using Signed = std::make_signed_t<T>;
    constexpr float kUnit = sizeof(T) == 1 ? 1 : 256;
    return {float(colour[0]) * 100 / float(T(-1)), float(Signed(colour[1])) / kUnit, float(Signed(colour[2])) / kUnit};
}

}  // namespace

PixelConverter::PixelConverter(const SampleLayout& layout, std::optional<ProfileTransform> transform)
    : layout_(layout), transform_(std::move(transform)) {}

void PixelConverter::convert(const void* samples, std::span<Rgba8> pixels) const {
    switch (layout_.type) {
        case SampleType::uint8: return convert_typed(static_cast<const std::uint8_t*>(samples), pixels);
        case SampleType::uint16: return convert_typed(static_cast<const std::uint16_t*>(samples), pixels);
        case SampleType::float32: return convert_typed(static_cast<const float*>(samples), pixels);
    }
}

template <class T>
void PixelConverter::convert_typed(const T* samples, std::span<Rgba8> pixels) const {
    const auto stride = std::size_t(layout_.channels);
    constexpr std::size_t kRun = 1024;
    std::array<T, kRun * 4> colours;
    std::array<std::uint8_t, kRun * 3> rgb;
    for (std::size_t begin = 0; begin < pixels.size(); begin += kRun) {
        const std::size_t count = std::min(kRun, pixels.size() - begin);
        const T* in = samples + begin * stride;
        gather(in, count, colours.data());
        to_srgb(colours.data(), count, rgb.data());
        for (std::size_t n = 0; n < count; ++n) {
            const std::uint8_t a = layout_.alpha < 0 ? 255 : alpha8(in[n * stride + std::size_t(layout_.alpha)]);
            pixels[begin + n] = {rgb[n * 3], rgb[n * 3 + 1], rgb[n * 3 + 2], a};
        }
    }
}

/// The colours of `count` pixels without gaps, straight, 0 being black.
template <class T>
void PixelConverter::gather(const T* in, std::size_t count, T* colours) const {
    const auto stride = std::size_t(layout_.channels), channels = std::size_t(layout_.colours);
    for (std::size_t c = 0; c < channels; ++c) {
        const T* channel = in + layout_.colour[c];
        for (std::size_t n = 0; n < count; ++n) colours[n * channels + c] = channel[n * stride];
    }
    if (layout_.alpha >= 0 && layout_.premultiplied)
        for (std::size_t n = 0; n < count; ++n)
            for (std::size_t c = 0; c < channels; ++c) {
                T& colour = colours[n * channels + c];
                colour = straight(colour, in[n * stride + std::size_t(layout_.alpha)]);
            }
    if (layout_.inverted)
        std::transform(colours, colours + count * channels, colours, [](T v) { return white<T>() - v; });
}

template <class T>
void PixelConverter::to_srgb(T* colours, std::size_t count, std::uint8_t* rgb) const {
    const auto channels = std::size_t(layout_.colours);
    if (!layout_.palette.empty()) {
        for (std::size_t n = 0; n < count; ++n) {
            const Rgba8 entry = layout_.palette[std::min(std::size_t(colours[n]), layout_.palette.size() - 1)];
            rgb[n * 3] = entry.r, rgb[n * 3 + 1] = entry.g, rgb[n * 3 + 2] = entry.b;
        }
    } else if (layout_.lab) {
        if constexpr (!std::is_same_v<T, float>)
            for (std::size_t n = 0; n < count; ++n) transform_->apply(lab(colours + n * 3).data(), rgb + n * 3, 1);
    } else if (transform_) {
        if constexpr (std::is_same_v<T, float>) std::transform(colours, colours + count * channels, colours, unit);
        transform_->apply(colours, rgb, count);
    } else if (channels == 4) {
        for (std::size_t n = 0; n < count; ++n)
            for (std::size_t c = 0; c < 3; ++c)
                rgb[n * 3 + c] = alpha8((1 - ink(colours[n * 4 + c])) * (1 - ink(colours[n * 4 + 3])));
    } else if (channels == 3) {
        for (std::size_t n = 0; n < count * 3; ++n) rgb[n] = colour8(colours[n]);
    } else {
        for (std::size_t n = 0; n < count; ++n) rgb[n * 3] = rgb[n * 3 + 1] = rgb[n * 3 + 2] = colour8(colours[n]);
    }
}

}  // namespace dstylize::codec
