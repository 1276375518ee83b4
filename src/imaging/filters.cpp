#include "imaging/filters.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace dstylize {
namespace {

cv::Mat mat(const Grid<float>& g) { return cv::Mat(g.extent().y, g.extent().x, CV_32F, const_cast<float*>(g.data())); }
Grid<float> like(const Grid<float>& g) { return Grid<float>(g.extent()); }

constexpr int kBins = 65536;
struct Histogram {
    float lo = 0, scale = 0;
    std::vector<std::uint32_t> count;
    int bin(float v) const { return std::min(kBins - 1, int((v - lo) * scale)); }
    float percentile(float percent, std::size_t samples) const {
        if (scale == 0) return lo;
        const auto wanted = std::uint64_t(double(percent) / 100 * double(samples));
        std::uint64_t seen = 0;
        for (int b = 0; b < kBins; ++b) {
            seen += count[std::size_t(b)];
            if (seen > wanted) return lo + (float(b) + 0.5f) / scale;
        }
        return lo + float(kBins) / scale;
    }
};
Histogram histogram(const Grid<float>& field) {
    Histogram h;
    double lo = 0, hi = 0;
    cv::minMaxLoc(mat(field), &lo, &hi);
    h.lo = float(lo);
    h.scale = hi > lo ? float(kBins) / (float(hi) - h.lo) : 0;
    // Each band counts for itself.
    constexpr std::size_t kBand = std::size_t{1} << 18;
    const std::size_t bands = (field.size() + kBand - 1) / kBand;
    std::vector<std::vector<std::uint32_t>> counts(bands);
    tbb::parallel_for(std::size_t{0}, bands, [&](std::size_t band) {
        counts[band].assign(kBins, 0);
        const std::size_t end = std::min(field.size(), (band + 1) * kBand);
        for (std::size_t n = band * kBand; n < end; ++n) ++counts[band][std::size_t(h.bin(field[n]))];
    });
    h.count = std::move(counts.front());
    for (std::size_t band = 1; band < bands; ++band)
        std::transform(counts[band].begin(), counts[band].end(), h.count.begin(), h.count.begin(), std::plus<>());
    return h;
}

/// cv::GaussianBlur in bands of rows at once. OpenCV reads beyond a band what lies there, so the bands do not show.
void gaussian_blur(const cv::Mat& from, cv::Mat& to, double sigma) {
    constexpr int kRows = 192;
    const tbb::blocked_range<int> rows(0, from.rows, kRows);
    tbb::parallel_for(
        rows,
        [&](const tbb::blocked_range<int>& band) {
            cv::Mat part = to.rowRange(band.begin(), band.end());
            cv::GaussianBlur(from.rowRange(band.begin(), band.end()), part, cv::Size(0, 0), sigma, sigma,
                             cv::BORDER_REFLECT);
        },
        tbb::simple_partitioner());
}

}  // namespace

Grid<float> resized(const Grid<float>& field, Extent extent) {
    if (field.extent() == extent) return field;
    Grid<float> out(extent);
    cv::Mat target = mat(out);
    const bool grows = extent.x > field.extent().x || extent.y > field.extent().y;
    cv::resize(mat(field), target, target.size(), 0, 0, grows ? cv::INTER_CUBIC : cv::INTER_AREA);
    if (grows) {  // cubic interpolation overshoots
        const auto [lo, hi] = std::minmax_element(field.begin(), field.end());
        transform(out, [lo = *lo, hi = *hi](float v) { return std::clamp(v, lo, hi); });
    }
    return out;
}

Picture resized(const Picture& picture, Extent extent) {
    if (picture.extent() == extent) return picture;
    const auto scaled = [](int channel, int factor, int divisor) {
        return std::uint8_t(std::min(255, (channel * factor + divisor / 2) / divisor));
    };
    Picture source = picture;  // premultiplied while it is filtered
    for (Rgba8& p : source)
        if (p.a < 255) p = {scaled(p.r, p.a, 255), scaled(p.g, p.a, 255), scaled(p.b, p.a, 255), p.a};
    Picture out(extent);
    const cv::Mat from(source.extent().y, source.extent().x, CV_8UC4, source.data());
    cv::Mat to(extent.y, extent.x, CV_8UC4, out.data());
    const bool grows = extent.x > source.extent().x || extent.y > source.extent().y;
    cv::resize(from, to, to.size(), 0, 0, grows ? cv::INTER_CUBIC : cv::INTER_AREA);
    for (Rgba8& p : out)
        if (p.a > 0 && p.a < 255) p = {scaled(p.r, 255, p.a), scaled(p.g, 255, p.a), scaled(p.b, 255, p.a), p.a};
    return out;
}

Grid<float> blurred(const Grid<float>& field, float sigma) {
    Grid<float> out = like(field);
    cv::Mat target = mat(out);
    constexpr float kWide = 8, kReducedSigma = 4;
    if (sigma <= kWide) {
        gaussian_blur(mat(field), target, sigma);
        return out;
    }
    const float factor = sigma / kReducedSigma;
    cv::Mat small;
    const cv::Size size(std::max(1, cvRound(float(field.extent().x) / factor)),
                        std::max(1, cvRound(float(field.extent().y) / factor)));
    cv::resize(mat(field), small, size, 0, 0, cv::INTER_AREA);
    cv::Mat smooth(small.size(), small.type());
    gaussian_blur(small, smooth, kReducedSigma);
    cv::resize(smooth, target, target.size(), 0, 0, cv::INTER_LINEAR);
    return out;
}

Derivatives derivatives(const Grid<float>& field) {
    Derivatives d{like(field), like(field)};
    cv::Mat x = mat(d.x), y = mat(d.y);
    cv::Sobel(mat(field), x, CV_32F, 1, 0, 3, 0.125, 0, cv::BORDER_REFLECT);
    cv::Sobel(mat(field), y, CV_32F, 0, 1, 3, 0.125, 0, cv::BORDER_REFLECT);
    return d;
}

StructureTensor structure_tensor(const Derivatives& d) {
    StructureTensor t{d.x, d.x, d.y};
    each_index(d.x.size(), [&](std::size_t n) {
        t.xx[n] = d.x[n] * d.x[n];
        t.xy[n] = d.x[n] * d.y[n];
        t.yy[n] = d.y[n] * d.y[n];
    });
    return t;
}

Grid<float> gradient_magnitude(const Grid<float>& field) {
    Derivatives d = derivatives(field);
    each_index(d.x.size(), [&](std::size_t n) { d.x[n] = std::sqrt(d.x[n] * d.x[n] + d.y[n] * d.y[n]); });
    return std::move(d.x);
}

float percentile(const Grid<float>& field, float percent) { return histogram(field).percentile(percent, field.size()); }

std::pair<float, float> percentiles(const Grid<float>& field, float low_percent, float high_percent) {
    const Histogram h = histogram(field);
    return {h.percentile(low_percent, field.size()), h.percentile(high_percent, field.size())};
}

Grid<float> rank(const Grid<float>& field) {
    Histogram h = histogram(field);
    std::uint32_t below = 0;
    for (auto& c : h.count) below += std::exchange(c, below);
    Grid<float> out = like(field);
    each_index(field.size(),
               [&](std::size_t n) { out[n] = float(h.count[std::size_t(h.bin(field[n]))]) / float(field.size()); });
    return out;
}

Grid<float> luma_plane(const Picture& picture) {
    Grid<float> out(picture.extent());
    std::transform(picture.begin(), picture.end(), out.begin(), [](Rgba8 p) {
        const float a = float(p.a) / 255, y = luma({float(p.r) / 255, float(p.g) / 255, float(p.b) / 255, 1});
        return 1 - a * (1 - y);
    });
    return out;
}

Grid<float> alpha_plane(const Picture& picture) {
    Grid<float> out(picture.extent());
    std::transform(picture.begin(), picture.end(), out.begin(), [](Rgba8 p) { return float(p.a) / 255; });
    return out;
}

}  // namespace dstylize
