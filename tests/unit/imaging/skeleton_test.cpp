#include "imaging/skeleton.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace dstylize {
namespace {

using Shape = Grid<std::uint8_t>;

void fill(Shape& shape, int x0, int y0, int x1, int y1) {
    for (int j = y0; j < y1; ++j)
        for (int i = x0; i < x1; ++i) shape(i, j) = 1;
}
std::size_t count(const Shape& shape) { return std::size_t(std::count(shape.begin(), shape.end(), 1)); }
int parts(const Shape& shape) {
    const Grid<int> part = nearest_part(shape);
    return 1 + *std::max_element(part.begin(), part.end());
}

TEST(Skeleton, OfABarIsItsMiddleLine) {
    Shape bar({120, 40});
    fill(bar, 10, 14, 110, 27);
    const Shape axis = skeleton(bar);
    EXPECT_LT(count(axis), 130u);
    EXPECT_GT(count(axis), 80u);
    for (int j = 0; j < 40; ++j)
        for (int i = 30; i < 90; ++i)
            if (axis(i, j)) {
                EXPECT_NEAR(j, 20, 1) << i;
            }
}

TEST(Skeleton, KeepsOneLineForEveryPartHoweverSmall) {
    Shape shape({60, 60});
    fill(shape, 5, 5, 7, 7);      // thinning alone would eat this whole
    fill(shape, 20, 20, 21, 21);  // one node
    fill(shape, 30, 30, 50, 36);
    const Shape axis = skeleton(shape);
    EXPECT_EQ(parts(shape), 3);
    EXPECT_EQ(parts(axis), 3);
    for (std::size_t n = 0; n < axis.size(); ++n) EXPECT_LE(axis[n], shape[n]) << "the axis lies in the shape";
}

TEST(Skeleton, OfARingIsARing) {
    Shape ring({80, 80});
    for (int j = 0; j < 80; ++j)
        for (int i = 0; i < 80; ++i) {
            const double r = std::hypot(i - 40, j - 40);
            ring(i, j) = r > 18 && r < 32;
        }
    const Shape axis = skeleton(ring);
    EXPECT_EQ(parts(axis), 1);
    for (int j = 0; j < 80; ++j)
        for (int i = 0; i < 80; ++i)
            if (axis(i, j)) {
                EXPECT_NEAR(std::hypot(i - 40, j - 40), 25, 2.5);
            }
    // The middle is still enclosed: nothing outside of the ring is joined to it but through the axis.
    Shape around({80, 80});
    for (std::size_t n = 0; n < around.size(); ++n) around[n] = !axis[n];
    std::vector<std::pair<int, int>> open{{0, 0}};
    around(0, 0) = 0;
    while (!open.empty()) {
        const auto [i, j] = open.back();
        open.pop_back();
        for (const auto& [di, dj] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
            if (around.extent().contains(i + di, j + dj) && around(i + di, j + dj)) {
                around(i + di, j + dj) = 0;
                open.emplace_back(i + di, j + dj);
            }
    }
    EXPECT_EQ(around(40, 40), 1);
}

TEST(Skeleton, StemWidthIsTheWidthOfTheBars) {
    Shape shape({200, 100});
    fill(shape, 10, 10, 190, 24);
    fill(shape, 60, 24, 74, 95);
    EXPECT_NEAR(stem_width(shape), 14, 1.5);
    EXPECT_EQ(stem_width(Shape({20, 20})), 0);
}

TEST(Skeleton, DepthIsPositiveInsideAndChangesSignAtTheOutline) {
    Shape shape({40, 40});
    fill(shape, 10, 10, 30, 30);
    const Grid<float> depth = signed_depth(shape);
    EXPECT_FLOAT_EQ(depth(10, 20), 0.5f);
    EXPECT_FLOAT_EQ(depth(9, 20), -0.5f);
    EXPECT_FLOAT_EQ(depth(20, 20), 9.5f);
    EXPECT_FLOAT_EQ(depth(5, 20), -4.5f);
}

}  // namespace
}  // namespace dstylize
