#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "codec/profile.h"
#include "core/picture.h"

namespace dstylize::codec {

/// What a file's interleaved samples mean.
struct SampleLayout {
    SampleType type = SampleType::uint8;
    int channels = 3;              ///< samples per pixel as they lie in memory
    int colours = 3;               ///< of which colour: 1 grey, 3 RGB, 4 CMYK (0: no ink)
    int colour[4] = {0, 1, 2, 3};  ///< where each colour lies
    int alpha = -1;                ///< where alpha lies; -1: opaque
    bool premultiplied = false;    ///< colours are multiplied by alpha (associated)
    bool inverted = false;         ///< stored as most - value
    bool lab = false;              ///< 3 colours as TIFF stores CIE L*a*b*; integers only
    std::vector<Rgba8> palette;    ///< not empty: the one colour is an index

    std::size_t sample_bytes() const { return type == SampleType::uint8 ? 1 : type == SampleType::uint16 ? 2 : 4; }
    std::size_t pixel_bytes() const { return sample_bytes() * std::size_t(channels); }
};

/// Turns samples into straight 8-bit sRGB. Floats are linear light unless a profile says otherwise;
/// values outside [0, 1] are clamped (infinities too), NaN counts as 0. CMYK without a profile is
/// (1 - ink)(1 - black).
class PixelConverter {
  public:
    PixelConverter(const SampleLayout& layout, std::optional<ProfileTransform> transform);
    void convert(const void* samples, std::span<Rgba8> pixels) const;

  private:
    template <class T>
    void convert_typed(const T* samples, std::span<Rgba8> pixels) const;
    template <class T>
    void gather(const T* in, std::size_t count, T* colours) const;
    template <class T>
    void to_srgb(T* colours, std::size_t count, std::uint8_t* rgb) const;
    SampleLayout layout_;
    std::optional<ProfileTransform> transform_;
};

}  // namespace dstylize::codec
