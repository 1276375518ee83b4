// Signed areas: every edge adds, to each sample it crosses, the area between it and the sample's right
// border, and its height to all samples to the right; a running sum along a row yields the winding's area.
#include "render/detail_polygon.h"

#include <algorithm>
#include <cmath>

namespace dstylize {
namespace {

class AreaSums {
  public:
    AreaSums(std::vector<float>& sums, int width, int height) : sums_(sums), width_(width), height_(height) {
        sums_.assign(std::size_t(width + 1) * std::size_t(height), 0.0f);
    }

    void add_edge(Vec2f a, Vec2f b) {
        if (a.y == b.y) return;
        const float sign = a.y < b.y ? 1.0f : -1.0f;
        if (a.y > b.y) std::swap(a, b);
        const float slope = (b.x - a.x) / (b.y - a.y);
        const float height = float(height_);
        const int first = int(std::clamp(std::floor(a.y), 0.0f, height));
        const int last = int(std::clamp(std::ceil(b.y), 0.0f, height));
        for (int y = first; y < last; ++y) {
            const float top = std::max(a.y, float(y)), bottom = std::min(b.y, float(y + 1));
            if (top >= bottom) continue;
            const float x0 = a.x + (top - a.y) * slope, x1 = a.x + (bottom - a.y) * slope;
            add_in_row(y, std::min(x0, x1), std::max(x0, x1), (bottom - top) * sign);
        }
    }

    const float* row(int y) const { return sums_.data() + std::size_t(y) * std::size_t(width_ + 1); }

  private:
    /// A piece of an edge within one row, from x0 <= x1, of signed height.
    void add_in_row(int y, float x0, float x1, float height) {
        float* sums = sums_.data() + std::size_t(y) * std::size_t(width_ + 1);
        const float right = float(width_);
        if (x0 >= right) return;
        const float run = x1 - x0;
        if (run <= 0) {
            add_in_sample(sums, std::max(x0, 0.0f), std::max(x0, 0.0f), height);
            return;
        }
        if (x0 < 0) {
            const float outside = std::min(x1, 0.0f) - x0;
            sums[0] += height * (outside / run);
            x0 = 0;
        }
        const float stop = std::min(x1, right);
        while (x0 < stop) {
            const float next = std::min(std::floor(x0) + 1, stop);
            add_in_sample(sums, x0, next, height * ((next - x0) / run));
            x0 = next;
        }
    }

    void add_in_sample(float* sums, float x0, float x1, float height) {
        const int x = std::min(int(x0), width_ - 1);
        const float share_right = 0.5f * (x0 + x1) - float(x);
        sums[x] += height * (1 - share_right);
        sums[x + 1] += height * share_right;
    }

    std::vector<float>& sums_;
    int width_, height_;
};

}  // namespace

void paint_polygon(CoveragePlane& plane, std::span<const Vec2f> outline, std::uint32_t colour,
                   std::vector<float>& scratch) {
    if (outline.size() < 3) return;
    Vec2f lo = outline[0] - plane.origin, hi = lo;
    for (Vec2f p : outline) {
        p = p - plane.origin;
        lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)};
        hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
    }
    const float width = float(plane.width), height = float(plane.height);
    if (lo.x >= width || lo.y >= height || hi.x <= 0 || hi.y <= 0) return;
    const int x0 = int(std::max(lo.x, 0.0f)), x1 = int(std::ceil(std::min(hi.x, width)));
    const int y0 = int(std::max(lo.y, 0.0f)), y1 = int(std::ceil(std::min(hi.y, height)));

    AreaSums sums(scratch, x1 - x0, y1 - y0);
    const Vec2f corner = plane.origin + Vec2f{float(x0), float(y0)};
    for (std::size_t i = 0; i < outline.size(); ++i)
        sums.add_edge(outline[i] - corner, outline[(i + 1) % outline.size()] - corner);
    for (int y = y0; y < y1; ++y) {
        const float* row = sums.row(y - y0);
        float* coverage = plane.coverage_row(y);
        std::uint32_t* winner = plane.colour_row(y);
        float sum = 0;
        for (int x = x0; x < x1; ++x) {
            sum += row[x - x0];
            const float covered = std::min(std::abs(sum), 1.0f);
            if (covered < coverage[x] || covered <= kLeastCoverage) continue;
            coverage[x] = covered;
            winner[x] = colour;
        }
    }
    plane.dirty.include(x0, y0, x1, y1);
}

}  // namespace dstylize
