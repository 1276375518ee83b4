#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/error.h"
#include "formats/picture_codec.h"
#include "unit/formats/picture_files.h"

namespace dstylize::test {

inline CodecOptions codec_options() {
    CodecOptions options;
    options.program = DSTYLIZE_CODEC;
    return options;
}

/// Tests of what the codec does share one process of it.
class CodecTest : public testing::Test {
  protected:
    static void SetUpTestSuite() { codec_ = new PictureCodec(codec_options()); }
    static void TearDownTestSuite() {
        delete codec_;
        codec_ = nullptr;
    }
    static PictureCodec& codec() { return *codec_; }
    static DecodedPicture decoded(const FileBytes& file) { return codec().decode(file, "picture"); }
    static FileBytes encoded(const Picture& picture, const EncodeOptions& options) {
        return codec().encode(picture, options, "picture");
    }

    /// Four quarters, red, green, blue and yellow, of an oblong picture.
    static Picture quarters() {
        Picture picture({48, 32});
        for (int j = 0; j < 32; ++j)
            for (int i = 0; i < 48; ++i)
                picture(i, j) = j < 16 ? (i < 24 ? Rgba8{220, 0, 0} : Rgba8{0, 200, 0})
                                       : (i < 24 ? Rgba8{0, 0, 210} : Rgba8{230, 230, 0});
        return picture;
    }

  private:
    inline static PictureCodec* codec_ = nullptr;
};

inline int difference(Rgba8 a, Rgba8 b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b), std::abs(a.a - b.a)});
}

inline int largest_difference(const Picture& a, const Picture& b) {
    if (a.extent() != b.extent()) return 999;
    int largest = 0;
    for (std::size_t n = 0; n < a.size(); ++n) largest = std::max(largest, difference(a[n], b[n]));
    return largest;
}

inline std::vector<Rgba8> pixels(const DecodedPicture& decoded) {
    return {decoded.picture.begin(), decoded.picture.end()};
}

/// The sRGB code of linear light.
inline std::uint8_t srgb(double light) {
    const double encoded = light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
    return std::uint8_t(std::lround(std::clamp(encoded, 0.0, 1.0) * 255));
}

/// What `act` throws; fails the test when it throws nothing.
template <class Act>
Error error_of(Act act) {
    try {
        act();
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        return error;
    }
    ADD_FAILURE() << "no error";
    return Error(ErrorCode::failed, "", "", "");
}

}  // namespace dstylize::test

namespace dstylize {
inline void PrintTo(const Rgba8& c, std::ostream* out) {
    *out << '(' << int(c.r) << ' ' << int(c.g) << ' ' << int(c.b) << ' ' << int(c.a) << ')';
}
}  // namespace dstylize
