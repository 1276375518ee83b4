#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "codec/byte_reader.h"

namespace dstylize::codec {

/// The types in which samples are read from a file. Integers are sRGB-encoded unless a profile says
/// otherwise, floats are linear.
enum class SampleType { uint8, uint16, float32 };

/// How values relate to light: by default linear light of the primaries of sRGB and Rec. 709.
struct StatedColours {
    double gamma = 1;  ///< values = light ^ (1 / gamma)
    /// CIE x and y of red, green, blue and white.
    double red[2] = {0.64, 0.33}, green[2] = {0.30, 0.60}, blue[2] = {0.15, 0.06}, white[2] = {0.3127, 0.3290};
};

/// Converts colours from an embedded profile to 8-bit sRGB (relative colorimetric with black point
/// compensation, as browsers and print shops do).
class ProfileTransform {
  public:
    /// Throws Refusal when the profile is unusable or not one for `channels` (1 grey, 3 RGB, 4 CMYK).
    ProfileTransform(Bytes icc_profile, int channels, SampleType type);
    /// For pictures that state their colours by numbers instead.
    ProfileTransform(const StatedColours& stated, int channels, SampleType type);
    /// For CIE L*a*b* (D50) in floats: L* in [0, 100].
    static ProfileTransform from_lab();
    ProfileTransform(ProfileTransform&&) noexcept;
    ProfileTransform& operator=(ProfileTransform&&) noexcept;
    ~ProfileTransform();

    /// True when it changes no 8-bit value by more than 1: the profile is sRGB by whatever name.
    bool is_identity() const;

    /// `count` colours of `channels` samples each, into 3 bytes each.
    void apply(const void* colours, std::uint8_t* rgb, std::size_t count) const;

  private:
    struct Handles;
    explicit ProfileTransform(std::unique_ptr<Handles> handles);
    std::unique_ptr<Handles> handles_;
};

/// Whether the profile's header names a colour space of so many channels.
bool is_profile_for(Bytes icc_profile, int channels);

/// An ICC profile of sRGB, always the same bytes.
const std::string& srgb_profile();

}  // namespace dstylize::codec
