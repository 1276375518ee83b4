#include "codec/profile.h"

#include <lcms2.h>

#include <array>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "codec/refusal.h"

namespace dstylize::codec {
namespace {

cmsColorSpaceSignature colour_space(int channels) {
    return channels == 1 ? cmsSigGrayData : channels == 3 ? cmsSigRgbData : cmsSigCmykData;
}

cmsUInt32Number lcms_type(int channels, SampleType type) {
    const int space = channels == 1 ? PT_GRAY : channels == 3 ? PT_RGB : PT_CMYK;
    const cmsUInt32Number layout = COLORSPACE_SH(space) | CHANNELS_SH(channels);
    switch (type) {
        case SampleType::uint8: return layout | BYTES_SH(1);
        case SampleType::uint16: return layout | BYTES_SH(2);
        case SampleType::float32: return layout | BYTES_SH(4) | FLOAT_SH(1);
    }
    return 0;
}

}  // namespace

struct ProfileTransform::Handles {
    cmsHTRANSFORM transform = nullptr;
    int channels = 0;
    SampleType type{};

    /// Takes `source` over.
    Handles(cmsHPROFILE source, cmsColorSpaceSignature space, cmsUInt32Number source_type, int n, SampleType t)
        : channels(n), type(t) {
        const cmsHPROFILE target = cmsCreate_sRGBProfile();
        if (source && target && cmsGetColorSpace(source) == space)
            transform = cmsCreateTransform(source, source_type, target, TYPE_RGB_8, INTENT_RELATIVE_COLORIMETRIC,
                                           cmsFLAGS_BLACKPOINTCOMPENSATION | cmsFLAGS_NOCACHE);
        if (target) cmsCloseProfile(target);
        if (source) cmsCloseProfile(source);
        if (!transform) throw Refusal("has an unusable colour profile", "export it as sRGB");
    }
    Handles(const Handles&) = delete;
    Handles& operator=(const Handles&) = delete;
    ~Handles() { cmsDeleteTransform(transform); }

    static std::unique_ptr<Handles> from(cmsHPROFILE source, int n, SampleType t) {
        return std::make_unique<Handles>(source, colour_space(n), lcms_type(n, t), n, t);
    }
};

ProfileTransform::ProfileTransform(std::unique_ptr<Handles> handles) : handles_(std::move(handles)) {}

ProfileTransform::ProfileTransform(Bytes icc_profile, int channels, SampleType type)
    : handles_(Handles::from(cmsOpenProfileFromMem(icc_profile.data(), cmsUInt32Number(icc_profile.size())), channels,
                             type)) {}

ProfileTransform::ProfileTransform(const StatedColours& stated, int channels, SampleType type) {
    cmsToneCurve* curve = cmsBuildGamma(nullptr, stated.gamma);
    cmsToneCurve* const curves[] = {curve, curve, curve};
    const auto xy = [](const double(&point)[2]) { return cmsCIExyY{point[0], point[1], 1.0}; };
    const cmsCIExyY white = xy(stated.white);
    const cmsCIExyYTRIPLE primaries{xy(stated.red), xy(stated.green), xy(stated.blue)};
    const cmsHPROFILE source =
        channels == 1 ? cmsCreateGrayProfile(&white, curve) : cmsCreateRGBProfile(&white, &primaries, curves);
    cmsFreeToneCurve(curve);
    handles_ = Handles::from(source, channels, type);
}

ProfileTransform ProfileTransform::from_lab() {
    return ProfileTransform(
        std::make_unique<Handles>(cmsCreateLab4Profile(nullptr), cmsSigLabData, TYPE_Lab_FLT, 3, SampleType::float32));
}

ProfileTransform::ProfileTransform(ProfileTransform&&) noexcept = default;
ProfileTransform& ProfileTransform::operator=(ProfileTransform&&) noexcept = default;
ProfileTransform::~ProfileTransform() = default;

void ProfileTransform::apply(const void* colours, std::uint8_t* rgb, std::size_t count) const {
    cmsDoTransform(handles_->transform, colours, rgb, cmsUInt32Number(count));
}

bool ProfileTransform::is_identity() const {
    const int channels = handles_->channels;
    if (channels == 4) return false;
    // A cube of 9 values a channel, coarse enough to be free and fine enough to tell any two curves apart.
    constexpr int kSteps = 9;
    std::vector<std::array<int, 3>> wanted;
    for (int n = 0; n < (channels == 1 ? kSteps : kSteps * kSteps * kSteps); ++n) {
        const auto value = [](int step) { return step * 255 / (kSteps - 1); };
        const int last = value(n % kSteps);
        if (channels == 1)
            wanted.push_back({last, last, last});
        else
            wanted.push_back({value(n / kSteps / kSteps), value(n / kSteps % kSteps), last});
    }
    std::vector<std::uint8_t> out(wanted.size() * 3);
    const auto fill = [&]<class T>(T scale) {
        std::vector<T> in;
        for (const auto& colour : wanted)
            for (int c = 0; c < channels; ++c) in.push_back(T(colour[std::size_t(c)]) * scale);
        apply(in.data(), out.data(), wanted.size());
    };
    switch (handles_->type) {
        case SampleType::uint8: fill(std::uint8_t(1)); break;
        case SampleType::uint16: fill(std::uint16_t(257)); break;
        case SampleType::float32: return false;  // without a transform floats would count as linear
    }
    for (std::size_t n = 0; n < wanted.size(); ++n)
        for (std::size_t c = 0; c < 3; ++c)
            if (std::abs(int(out[n * 3 + c]) - wanted[n][c]) > 1) return false;
    return true;
}

bool is_profile_for(Bytes icc_profile, int channels) {
    const std::string_view space = text_of(part(icc_profile, 16, 4));
    return space == (channels == 1 ? "GRAY" : channels == 3 ? "RGB " : "CMYK");
}

const std::string& srgb_profile() {
    static const std::string bytes = [] {
        const cmsHPROFILE profile = cmsCreate_sRGBProfile();
        cmsUInt32Number size = 0;
        cmsSaveProfileToMem(profile, nullptr, &size);
        std::string saved(size, '\0');
        cmsSaveProfileToMem(profile, saved.data(), &size);
        cmsCloseProfile(profile);
        // The header's date of creation would make every file differ.
        const char kDate[] = {7, char(0xe8), 0, 1, 0, 1, 0, 0, 0, 0, 0, 0};
        saved.replace(24, sizeof(kDate), kDate, sizeof(kDate));
        return saved;
    }();
    return bytes;
}

}  // namespace dstylize::codec
