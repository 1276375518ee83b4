#include "imaging/skeleton.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace dstylize {
namespace {

/// 0 inside the shape and 255 outside, as OpenCV's distances want it.
cv::Mat outside_of(const Grid<std::uint8_t>& shape) {
    cv::Mat out(shape.extent().y, shape.extent().x, CV_8U);
    std::transform(shape.begin(), shape.end(), out.data, [](std::uint8_t v) { return std::uint8_t(v ? 0 : 255); });
    return out;
}
bool has_inside(const Grid<std::uint8_t>& shape) {
    return std::any_of(shape.begin(), shape.end(), [](std::uint8_t v) { return v != 0; });
}

/// A shape with a border of outside nodes, thinned in place.
class Thinning {
  public:
    explicit Thinning(const Grid<std::uint8_t>& shape)
        : width_(shape.extent().x + 2),
          inside_(std::size_t(width_) * std::size_t(shape.extent().y + 2), 0),
          listed_(inside_.size(), 0),
          around_{-width_, 1 - width_, 1, 1 + width_, width_, width_ - 1, -1, -1 - width_} {
        for (int j = 0; j < shape.extent().y; ++j)
            for (int i = 0; i < shape.extent().x; ++i) inside_[at(i, j)] = shape(i, j) != 0;
        for (std::size_t n = 0; n < inside_.size(); ++n)
            if (inside_[n] && ring(n) != 0xff) {
                candidates_.push_back(n);
                listed_[n] = 1;
            }
    }

    void run() {
        bool first_idle = false;
        for (bool second = false;; second = !second) {
            const bool idle = !sweep(second);
            if (idle && first_idle) return;
            first_idle = idle;
        }
    }
    bool inside(int i, int j) const { return inside_[at(i, j)]; }

  private:
    std::size_t at(int i, int j) const { return std::size_t(j + 1) * std::size_t(width_) + std::size_t(i + 1); }

    /// The eight neighbours as bits, clockwise from the one above.
    unsigned ring(std::size_t n) const {
        unsigned bits = 0;
        for (unsigned k = 0; k < 8; ++k) bits |= unsigned(inside_[n + std::size_t(around_[k])]) << k;
        return bits;
    }
    static constexpr bool goes(unsigned bits, bool second) {
        const auto on = [bits](unsigned k) { return bits >> (k & 7u) & 1u; };
        unsigned count = 0, rises = 0;
        for (unsigned k = 0; k < 8; ++k) {
            count += on(k);
            rises += !on(k) && on(k + 1);
        }
        if (count < 2 || count > 6 || rises != 1) return false;
        const unsigned up = on(0), right = on(2), down = on(4), left = on(6);
        return second ? !(up && right && left) && !(up && down && left)
                      : !(up && right && down) && !(right && down && left);
    }

    /// `goes` of every ring, for the first and the second half-iteration.
    using Verdicts = std::array<std::array<bool, 256>, 2>;
    static constexpr Verdicts verdicts() {
        Verdicts out{};
        for (unsigned bits = 0; bits < 256; ++bits)
            for (const bool second : {false, true}) out[second][bits] = goes(bits, second);
        return out;
    }

    /// One half-iteration: whether anything went. All decisions are made before anything goes.
    bool sweep(bool second) {
        static constexpr Verdicts kGoes = verdicts();
        std::vector<std::size_t> gone, kept;
        for (const std::size_t n : candidates_) (kGoes[second][ring(n)] ? gone : kept).push_back(n);
        for (const std::size_t n : gone) inside_[n] = 0;
        for (const std::size_t n : gone)
            for (const int step : around_) {
                const std::size_t beside = n + std::size_t(step);
                if (inside_[beside] && !listed_[beside]) {
                    listed_[beside] = 1;
                    kept.push_back(beside);
                }
            }
        candidates_ = std::move(kept);
        return !gone.empty();
    }

    int width_;
    std::vector<std::uint8_t> inside_;
    std::vector<std::uint8_t> listed_;  ///< whether a node is, or was, among the candidates
    std::array<int, 8> around_;
    std::vector<std::size_t> candidates_;
};

}  // namespace

Grid<float> distance_to(const Grid<std::uint8_t>& shape) {
    const Extent e = shape.extent();
    if (!has_inside(shape)) return Grid<float>(e, std::hypot(float(e.x), float(e.y)));
    Grid<float> out(e);
    cv::Mat target(e.y, e.x, CV_32F, out.data());
    cv::distanceTransform(outside_of(shape), target, cv::DIST_L2, cv::DIST_MASK_PRECISE, CV_32F);
    return out;
}

namespace {

/// Distance of the nodes inside the shape to those outside.
Grid<float> depth_inside(const Grid<std::uint8_t>& shape) {
    Grid<std::uint8_t> outside(shape.extent());
    std::transform(shape.begin(), shape.end(), outside.begin(), [](std::uint8_t v) { return !v; });
    return distance_to(outside);
}

}  // namespace

Grid<float> signed_depth(const Grid<std::uint8_t>& shape) {
    const Grid<float> to_inside = distance_to(shape);
    Grid<float> out = depth_inside(shape);
    for (std::size_t n = 0; n < out.size(); ++n) out[n] = shape[n] ? out[n] - 0.5f : 0.5f - to_inside[n];
    return out;
}

Grid<int> nearest_part(const Grid<std::uint8_t>& shape) {
    const Extent e = shape.extent();
    Grid<int> out(e);
    if (!has_inside(shape)) return out;
    cv::Mat distance, labels(e.y, e.x, CV_32S, out.data());
    cv::distanceTransform(outside_of(shape), distance, labels, cv::DIST_L2, cv::DIST_MASK_5, cv::DIST_LABEL_CCOMP);
    for (int& part : out) --part;
    return out;
}

namespace {

/// Thinning eats parts of two by two nodes whole: those keep their deepest one.
void keep_a_node_of_each_part(const Grid<std::uint8_t>& shape, Grid<std::uint8_t>& axis) {
    const Extent e = shape.extent();
    Grid<int> part(e);
    cv::Mat labels(e.y, e.x, CV_32S, part.data());
    const int parts = cv::connectedComponents(255 - outside_of(shape), labels, 8, CV_32S);
    std::vector<bool> kept(std::size_t(parts), false);
    kept[0] = true;  // the outside
    for (std::size_t n = 0; n < axis.size(); ++n)
        if (axis[n]) kept[std::size_t(part[n])] = true;
    if (std::find(kept.begin(), kept.end(), false) == kept.end()) return;
    const Grid<float> depth = depth_inside(shape);
    std::vector<std::size_t> deepest(kept.size(), shape.size());
    for (std::size_t n = 0; n < shape.size(); ++n) {
        if (kept[std::size_t(part[n])]) continue;
        std::size_t& best = deepest[std::size_t(part[n])];
        if (best == shape.size() || depth[n] > depth[best]) best = n;
    }
    for (const std::size_t n : deepest)
        if (n < axis.size()) axis[n] = 1;
}

}  // namespace

Grid<std::uint8_t> skeleton(const Grid<std::uint8_t>& shape) {
    const Extent e = shape.extent();
    Grid<std::uint8_t> out(e);
    if (!has_inside(shape)) return out;
    Thinning thinning(shape);
    thinning.run();
    for (int j = 0; j < e.y; ++j)
        for (int i = 0; i < e.x; ++i) out(i, j) = thinning.inside(i, j);
    keep_a_node_of_each_part(shape, out);
    return out;
}

float stem_width(const Grid<std::uint8_t>& shape) {
    const Grid<std::uint8_t> axis = skeleton(shape);
    const Grid<float> depth = depth_inside(shape);
    std::vector<float> depths;
    for (std::size_t n = 0; n < axis.size(); ++n)
        if (axis[n]) depths.push_back(depth[n] - 0.5f);
    if (depths.empty()) return 0;
    std::nth_element(depths.begin(), depths.begin() + std::ptrdiff_t(depths.size() / 2), depths.end());
    return 2 * depths[depths.size() / 2];
}

}  // namespace dstylize
