#include <gtest/gtest.h>

#include <algorithm>

#include "imaging/skeleton.h"
#include "importance/fields.h"

namespace dstylize {
namespace {

constexpr Extent kExtent{256, 256};  // a quarter node per u at the default scale

/// Two bars with a gap of 4 nodes, and a speck.
Grid<float> bars() {
    Grid<float> mask(kExtent);
    for (int j = 40; j < 200; ++j)
        for (int i = 60; i < 124; ++i)
            if (i < 90 || i >= 94) mask(i, j) = 1;
    mask(200, 200) = 1;
    return mask;
}
Fields fields_of(FieldParameters p, const Grid<float>& mask = bars()) {
    UserMaps maps;
    maps.mask = mask;
    return Fields(Grid<float>(kExtent, 0.5f), p, std::move(maps), 1, 1.0f);
}
Grid<std::uint8_t> solid(const Grid<float>& mask) {
    Grid<std::uint8_t> out(mask.extent());
    std::transform(mask.begin(), mask.end(), out.begin(), [](float v) { return std::uint8_t(v >= 0.5f); });
    return out;
}

TEST(Shape, NothingGrowsFartherOutsideThanTheOverflow) {
    for (const float overflow : {0.0f, 3.0f, 9.0f}) {
        FieldParameters p;
        p.shape_overflow = overflow;
        p.shape_ragged = 6;
        Fields fields = fields_of(p);
        const Grid<float> depth = signed_depth(solid(bars()));
        float farthest = 0;
        for (std::size_t n = 0; n < depth.size(); ++n)
            if (fields.shape_interior()[n]) farthest = std::max(farthest, -depth[n]);
        EXPECT_LE(farthest, overflow);
        EXPECT_GE(farthest, overflow / 2) << "and the overflow is used";
    }
}

TEST(Shape, PartsStayApartAndNoneIsLost) {
    FieldParameters p;
    p.shape_overflow = 8;
    p.shape_ragged = 12;
    Fields fields = fields_of(p);
    const Grid<int> part = nearest_part(fields.shape_interior());
    EXPECT_EQ(1 + *std::max_element(part.begin(), part.end()), 3);
    EXPECT_TRUE(fields.shape_interior()(200, 200));
}

TEST(Shape, TheOutlineWandersWithTheSeedAndTheParameter) {
    FieldParameters p, ragged;
    ragged.shape_ragged = 8;
    const auto count = [](Fields fields) {
        return std::count(fields.shape_interior().begin(), fields.shape_interior().end(), 1);
    };
    EXPECT_EQ(count(fields_of(p)), 30 * 160 + 30 * 160 + 1);
    EXPECT_LT(count(fields_of(ragged)), 9000);
}

TEST(Shape, AxisRimAndRoomSayWhereInTheStrokeANodeIs) {
    FieldParameters p;
    p.axis_width = 5;
    p.rim_width = 2;
    Fields fields = fields_of(p);
    EXPECT_GT(fields["axis"](75, 120), 0.95f);
    EXPECT_LT(fields["axis"](61, 120), 0.1f);
    EXPECT_GT(fields["rim"](60, 120), 0.8f);
    EXPECT_EQ(fields["rim"](75, 120), 0);
    EXPECT_EQ(fields["rim"](50, 120), 0);
    EXPECT_NEAR(fields["room"](68, 120) * kRoom_u, 15, 1.5) << "half the width of the bar, anywhere in it";
    EXPECT_EQ(fields["shape"](75, 120), 1);
    EXPECT_EQ(fields["shape"](30, 120), 0);
}

TEST(Shape, WithoutAMaskItIsWhatIsDark) {
    Grid<float> luma(kExtent, 0.9f);
    for (int j = 100; j < 150; ++j)
        for (int i = 100; i < 150; ++i) luma(i, j) = 0.1f;
    Fields fields(luma, {}, {}, 1);
    EXPECT_EQ(fields["shape"](125, 125), 1);
    EXPECT_EQ(fields["shape"](20, 20), 0);
}

}  // namespace
}  // namespace dstylize
