// look RESULT PHOTO [RESULT PHOTO ...]: how much of a photograph its drawing shows.
//
// Each pair is compared at the smaller of its two sizes (the larger is averaged down by area), on luma of
// the sRGB values over white, with no stretch or fit of tones. Blurs are Gaussian, sigma in percent of the
// width: correlation and SSIM at 1, 2 and 4 %, correlation of the gradients' magnitudes at 0.6 %. Numbers
// see tone and contour, not beauty.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <span>
#include <vector>

#include "core/error.h"
#include "formats/files.h"
#include "formats/picture_codec.h"

namespace dstylize {
namespace {

constexpr std::array kSigmas_percent{1.0, 2.0, 4.0};
constexpr double kGradientSigma_percent = 0.6;
/// Of the SSIM's window: 7 px of 1024.
constexpr double kWindow_percent = 0.7;

cv::Mat luma_of(PictureCodec& codec, const std::filesystem::path& path) {
    constexpr std::uint64_t kMostBytes = 1u << 30;
    const DecodedPicture decoded = codec.decode(read_file(path, kMostBytes), path.string());
    const Picture& picture = decoded.picture;
    cv::Mat out(picture.extent().y, picture.extent().x, CV_32F);
    std::transform(picture.begin(), picture.end(), out.begin<float>(), [](Rgba8 c) {
        const float opaque = float(c.a) / 255;
        return luma({float(c.r), float(c.g), float(c.b)}) / 255 * opaque + (1 - opaque);
    });
    return out;
}

cv::Mat blurred_percent(const cv::Mat& image, double sigma_percent) {
    cv::Mat out;
    cv::GaussianBlur(image, out, {}, sigma_percent / 100 * image.cols, 0, cv::BORDER_REFLECT);
    return out;
}

cv::Mat gradient(const cv::Mat& image) {
    cv::Mat x, y, out;
    cv::Sobel(image, x, CV_32F, 1, 0, 3, 1, 0, cv::BORDER_REFLECT);
    cv::Sobel(image, y, CV_32F, 0, 1, 3, 1, 0, cv::BORDER_REFLECT);
    cv::magnitude(x, y, out);
    return out;
}

/// Pearson's; 0 when one of the two is constant.
double correlation(const cv::Mat& a, const cv::Mat& b) {
    cv::Scalar mean_a, mean_b, deviation_a, deviation_b;
    cv::meanStdDev(a, mean_a, deviation_a);
    cv::meanStdDev(b, mean_b, deviation_b);
    constexpr double kConstant = 1e-6;
    if (deviation_a[0] < kConstant || deviation_b[0] < kConstant) return 0;
    cv::Mat x, y;
    cv::subtract(a, mean_a, x, {}, CV_64F);
    cv::subtract(b, mean_b, y, {}, CV_64F);
    return x.dot(y) / double(a.total()) / (deviation_a[0] * deviation_b[0]);
}

/// Wang et al. 2004, with a Gaussian window; K1 = 0.01, K2 = 0.03.
double ssim(const cv::Mat& a, const cv::Mat& b) {
    constexpr double kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;
    const auto window = [](const cv::Mat& m) { return blurred_percent(m, kWindow_percent); };
    const cv::Mat mean_a = window(a), mean_b = window(b);
    const cv::Mat aa = mean_a.mul(mean_a), bb = mean_b.mul(mean_b), ab = mean_a.mul(mean_b);
    const cv::Mat variance = window(a.mul(a)) - aa + window(b.mul(b)) - bb;
    const cv::Mat covariance = window(a.mul(b)) - ab;
    const cv::Mat above = (2 * ab + kC1).mul(2 * covariance + kC2), below = (aa + bb + kC1).mul(variance + kC2);
    return cv::mean(above / below)[0];
}

constexpr std::size_t kFigures = 2 * kSigmas_percent.size() + 1;
using Figures = std::array<double, kFigures>;

Figures figures(cv::Mat result, cv::Mat photo) {
    cv::Mat& larger = result.cols > photo.cols ? result : photo;
    cv::resize(larger, larger, result.cols > photo.cols ? photo.size() : result.size(), 0, 0, cv::INTER_AREA);
    Figures out{};
    for (std::size_t i = 0; i < kSigmas_percent.size(); ++i) {
        const cv::Mat a = blurred_percent(result, kSigmas_percent[i]), b = blurred_percent(photo, kSigmas_percent[i]);
        out[i] = correlation(a, b);
        out[kSigmas_percent.size() + i] = ssim(a, b);
    }
    out.back() = correlation(gradient(blurred_percent(result, kGradientSigma_percent)),
                             gradient(blurred_percent(photo, kGradientSigma_percent)));
    return out;
}

void print_row(const std::string& name, const Figures& row, const std::string& size = "") {
    fmt::print("{:<28}", name);
    for (const double figure : row) fmt::print("{:>8.3f}", figure);
    fmt::print("   {}\n", size);
}

void compare(std::span<char* const> paths) {
    PictureCodec codec;
    fmt::print("{:<28}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}   {}\n", "", "corr 1%", "corr 2%", "corr 4%", "ssim 1%",
               "ssim 2%", "ssim 4%", "grad", "compared at");
    Figures sum{}, least;
    least.fill(std::numeric_limits<double>::max());
    for (std::size_t i = 0; i < paths.size(); i += 2) {
        const cv::Mat result = luma_of(codec, paths[i]), photo = luma_of(codec, paths[i + 1]);
        const bool at_photo = result.cols > photo.cols;
        const Figures row = figures(result, photo);
        for (std::size_t k = 0; k < kFigures; ++k) {
            sum[k] += row[k];
            least[k] = std::min(least[k], row[k]);
        }
        const cv::Mat& smaller = at_photo ? photo : result;
        print_row(std::filesystem::path(paths[i]).filename().string(), row,
                  fmt::format("{} x {} of the {}", smaller.cols, smaller.rows, at_photo ? "photograph" : "result"));
    }
    for (double& figure : sum) figure /= double(paths.size()) / 2;
    print_row("mean", sum);
    print_row("least", least);
}

}  // namespace
}  // namespace dstylize

int main(int argc, char** argv) {
    if (argc < 3 || argc % 2 == 0) {
        fmt::print(stderr, "usage: look RESULT PHOTO [RESULT PHOTO ...]\n");
        return 2;
    }
    try {
        dstylize::compare({argv + 1, argv + argc});
    } catch (const std::exception& error) {
        fmt::print(stderr, "look: {}\n", error.what());
        return 1;
    }
}
