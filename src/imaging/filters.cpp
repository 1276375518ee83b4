#include "imaging/filters.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace dstylize {
namespace {

cv::Mat mat(const Grid<float>& g) { return cv::Mat(g.extent().y, g.extent().x, CV_32F, const_cast<float*>(g.data())); }
Grid<float> like(const Grid<float>& g) { return Grid<float>::unset(g.extent()); }

/// Where samples lie between the least and the largest, in 65536 bins.
struct Bins {
    static constexpr int kCount = 65536;
    float lo = 0, scale = 0;  ///< scale 0: all samples are equal
    explicit Bins(const Grid<float>& field) {
        double least = 0, largest = 0;
        cv::minMaxLoc(mat(field), &least, &largest);
        lo = float(least);
        scale = largest > least ? float(kCount) / (float(largest) - lo) : 0;
    }
    int operator()(float v) const { return std::min(kCount - 1, int((v - lo) * scale)); }
    float middle(int bin) const { return lo + (float(bin) + 0.5f) / scale; }
};

/// Sums over all samples of what count(counts, bin) adds to so many counts; each band counts for itself.
template <class Count>
std::vector<std::uint32_t> counted(const Grid<float>& field, const Bins& bin, std::size_t counts, Count count) {
    constexpr std::size_t kBand = std::size_t{1} << 18;
    const std::size_t bands = (field.size() + kBand - 1) / kBand;
    std::vector<std::vector<std::uint32_t>> of_band(bands);
    tbb::parallel_for(std::size_t{0}, bands, [&](std::size_t band) {
        of_band[band].assign(counts, 0);
        const std::size_t end = std::min(field.size(), (band + 1) * kBand);
        for (std::size_t n = band * kBand; n < end; ++n) count(of_band[band], bin(field[n]));
    });
    for (std::size_t band = 1; band < bands; ++band)
        std::transform(of_band[band].begin(), of_band[band].end(), of_band[0].begin(), of_band[0].begin(),
                       std::plus<>());
    return std::move(of_band[0]);
}

/// Looks for percentiles among few wide bins, then within one of them: tables that stay in the first cache.
class Percentiles {
  public:
    explicit Percentiles(const Grid<float>& field) : field_(field), bin_(field) {
        if (bin_.scale == 0) return;
        wide_ = counted(field, bin_, kWide, [](auto& counts, int bin) { ++counts[std::size_t(bin / kFinePerWide)]; });
    }
    float operator()(float percent) const {
        if (bin_.scale == 0) return bin_.lo;
        auto left = std::uint64_t(double(percent) / 100 * double(field_.size()));
        std::size_t wide = 0;
        for (; wide < wide_.size() && left >= wide_[wide]; ++wide) left -= wide_[wide];
        if (wide == wide_.size()) return bin_.lo + float(Bins::kCount) / bin_.scale;
        const int first = int(wide) * kFinePerWide;
        const std::vector<std::uint32_t> fine = counted(field_, bin_, kFinePerWide, [first](auto& counts, int bin) {
            if (bin >= first && bin < first + kFinePerWide) ++counts[std::size_t(bin - first)];
        });
        int at = 0;
        for (; left >= fine[std::size_t(at)]; ++at) left -= fine[std::size_t(at)];
        return bin_.middle(first + at);
    }

  private:
    static constexpr int kFinePerWide = 64, kWide = Bins::kCount / kFinePerWide;
    const Grid<float>& field_;
    Bins bin_;
    std::vector<std::uint32_t> wide_;
};

/// Calls filter(from, to) for bands of rows, several at once. OpenCV reads beyond a band what lies there, so the bands
/// do not show.
template <class Filter>
void in_row_bands(const cv::Mat& from, cv::Mat& to, Filter filter) {
    constexpr int kRows = 192;
    tbb::parallel_for(
        tbb::blocked_range<int>(0, from.rows, kRows),
        [&](const tbb::blocked_range<int>& band) {
            cv::Mat part = to.rowRange(band.begin(), band.end());
            filter(from.rowRange(band.begin(), band.end()), part);
        },
        tbb::simple_partitioner());
}

void gaussian_blur(const cv::Mat& from, cv::Mat& to, double sigma) {
    in_row_bands(from, to, [sigma](const cv::Mat& band, cv::Mat& part) {
        cv::GaussianBlur(band, part, cv::Size(0, 0), sigma, sigma, cv::BORDER_REFLECT);
    });
}

void sobel(const cv::Mat& from, cv::Mat& to, int along_x, int along_y) {
    cv::Sobel(from, to, CV_32F, along_x, along_y, 3, 0.125, 0, cv::BORDER_REFLECT);
}

}  // namespace

Grid<float> resized(const Grid<float>& field, Extent extent) {
    if (field.extent() == extent) return field;
    Grid<float> out = Grid<float>::unset(extent);
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
    in_row_bands(mat(field), x, [](const cv::Mat& band, cv::Mat& part) { sobel(band, part, 1, 0); });
    in_row_bands(mat(field), y, [](const cv::Mat& band, cv::Mat& part) { sobel(band, part, 0, 1); });
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
    Grid<float> out = like(field);
    cv::Mat target = mat(out);
    in_row_bands(mat(field), target, [](const cv::Mat& band, cv::Mat& part) {
        cv::Mat x = part, y;
        sobel(band, x, 1, 0);
        sobel(band, y, 0, 1);
        for (int j = 0; j < x.rows; ++j) {
            float* const dx = x.ptr<float>(j);
            const float* const dy = y.ptr<float>(j);
            for (int i = 0; i < x.cols; ++i) dx[i] = std::sqrt(dx[i] * dx[i] + dy[i] * dy[i]);
        }
    });
    return out;
}

float percentile(const Grid<float>& field, float percent) { return Percentiles(field)(percent); }

std::pair<float, float> percentiles(const Grid<float>& field, float low_percent, float high_percent) {
    const Percentiles of(field);
    return {of(low_percent), of(high_percent)};
}

Grid<float> rank(const Grid<float>& field) {
    const Bins bin(field);
    std::vector<std::uint32_t> below =
        counted(field, bin, Bins::kCount, [](auto& counts, int at) { ++counts[std::size_t(at)]; });
    std::exclusive_scan(below.begin(), below.end(), below.begin(), 0u);
    return transformed(field, [&](float v) { return float(below[std::size_t(bin(v))]) / float(field.size()); });
}

Grid<float> luma_plane(const Picture& picture) {
    std::array<float, 256> share{};
    for (std::size_t v = 0; v < share.size(); ++v) share[v] = float(v) / 255;
    Grid<float> out = Grid<float>::unset(picture.extent());
    each_index(out.size(), [&](std::size_t n) {
        const Rgba8 p = picture[n];
        out[n] = 1 - share[p.a] * (1 - luma({share[p.r], share[p.g], share[p.b], 1}));
    });
    return out;
}

Grid<float> alpha_plane(const Picture& picture) {
    Grid<float> out = Grid<float>::unset(picture.extent());
    each_index(out.size(), [&](std::size_t n) { out[n] = float(picture[n].a) / 255; });
    return out;
}

}  // namespace dstylize
