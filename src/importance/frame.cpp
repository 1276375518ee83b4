#include "importance/frame.h"

#include <algorithm>
#include <cmath>

namespace dstylize {
namespace {

/// Standard deviation of a row or column that starts at `first`.
float deviation(const float* first, std::size_t stride, int count) {
    double sum = 0, squares = 0;
    for (int k = 0; k < count; ++k) {
        const double v = double(first[std::size_t(k) * stride]);
        sum += v;
        squares += v * v;
    }
    const double mean = sum / count;
    return float(std::sqrt(std::max(0.0, squares / count - mean * mean)));
}

/// How many of the outermost lines are frame. `line(k)`: deviation of the k-th line from outside.
template <class Line>
int frame_lines(int side, Line line) {
    constexpr float kFlat = 0.03f, kVaries = 0.05f, kMostShare = 0.03f;
    constexpr int kSoftEdge = 2;
    const int most = int(kMostShare * float(side));
    int lines = 0;
    while (lines < most && line(lines) < kFlat) ++lines;
    if (lines == 0 || lines == most) return 0;
    for (int k = lines; k <= std::min(lines + kSoftEdge, most); ++k)
        if (line(k) >= kVaries) return k + kSoftEdge;
    return 0;
}

}  // namespace

Frame flat_frame(const Grid<float>& luma) {
    const int w = luma.extent().x, h = luma.extent().y;
    const auto column = [&](int i) { return deviation(luma.data() + i, std::size_t(w), h); };
    const auto row = [&](int j) { return deviation(luma.row(j), 1, w); };
    return {frame_lines(w, column), frame_lines(h, row), frame_lines(w, [&](int k) { return column(w - 1 - k); }),
            frame_lines(h, [&](int k) { return row(h - 1 - k); })};
}

void paint_over_frame(Grid<float>& luma) {
    const Frame f = flat_frame(luma);
    if (f == Frame{}) return;
    const int w = luma.extent().x, h = luma.extent().y;
    for (int j = 0; j < h; ++j)
        for (int i = 0; i < w; ++i) {
            const int si = std::clamp(i, f.left, w - 1 - f.right), sj = std::clamp(j, f.top, h - 1 - f.bottom);
            if (si != i || sj != j) luma(i, j) = luma(si, sj);
        }
}

}  // namespace dstylize
