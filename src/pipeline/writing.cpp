#include "pipeline/writing.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace dstylize {
namespace {

constexpr float kMostWidth = 0.88f, kMostHeight = 0.72f;  // of the picture, when the size is ours to choose

/// Font size with which the ink fits into a share of the picture.
float fitting_em(const InkBox& box, Extent picture) {
    return std::min(kMostWidth * float(picture.x) / box.width, kMostHeight * float(picture.y) / box.height);
}

}  // namespace

Extent paper_extent(const Writing& writing) {
    constexpr float kLongSide = 1600, kPadding_em = 0.42f, kLeastShare = 0.2f;
    const InkBox box = ink_box(writing.lettering);
    const float width = box.width + 2 * kPadding_em, height = box.height + 2 * kPadding_em;
    const float scale = kLongSide / std::max(width, height);
    const auto side = [&](float em) { return int(std::lround(std::max(em * scale, kLeastShare * kLongSide))); };
    return {side(width), side(height)};
}

Picture letter_mask(const Writing& writing, Extent picture) {
    const InkBox box = ink_box(writing.lettering);
    const float em = writing.size > 0 ? writing.size * float(picture.y) : fitting_em(box, picture);
    const Vec2f centre{float(writing.x.px(picture.x)), float(writing.y.px(picture.y))};
    const float reach_x = em * box.width / 2, reach_y = em * box.height / 2;
    if (centre.x + reach_x <= 0 || centre.y + reach_y <= 0 || centre.x - reach_x >= float(picture.x) ||
        centre.y - reach_y >= float(picture.y))
        throw Error(ErrorCode::bad_usage, "", "the words lie outside the picture", "change --place or --text-size");
    const Grid<std::uint8_t> ink = text_mask(writing.lettering, picture, em, centre);
    Picture out(picture);
    std::transform(ink.begin(), ink.end(), out.begin(), [](std::uint8_t v) { return Rgba8{v, v, v, 255}; });
    return out;
}

}  // namespace dstylize
