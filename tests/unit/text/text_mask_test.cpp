#include "text/text_mask.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"
#include "imaging/skeleton.h"

namespace dstylize {
namespace {

constexpr Extent kFrame{600, 240};

Lettering words(const std::string& text) {
    Lettering out;
    out.text = text;
    return out;
}
Grid<std::uint8_t> mask(const Lettering& lettering) { return text_mask(lettering, kFrame, 100, {300, 120}); }
int parts(Grid<std::uint8_t> ink) {
    for (std::uint8_t& v : ink) v = v >= 128;
    const Grid<int> part = nearest_part(ink);
    return 1 + *std::max_element(part.begin(), part.end());
}
struct Bounds {
    int left = kFrame.x, right = -1, top = kFrame.y, bottom = -1;
};
Bounds bounds(const Grid<std::uint8_t>& ink) {
    Bounds b;
    for (int j = 0; j < kFrame.y; ++j)
        for (int i = 0; i < kFrame.x; ++i)
            if (ink(i, j) >= 128)
                b = {std::min(b.left, i), std::max(b.right, i), std::min(b.top, j), std::max(b.bottom, j)};
    return b;
}
std::string problem(const Lettering& lettering) {
    try {
        ink_box(lettering);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_usage);
        return error.problem();
    }
    return "";
}

TEST(TextMask, DotsAndAccentsAreParts) {
    EXPECT_EQ(parts(mask(words("l"))), 1);
    EXPECT_EQ(parts(mask(words("i"))), 2);
    EXPECT_EQ(parts(mask(words("jij"))), 6);
    EXPECT_EQ(parts(mask(words("\u00c4\u00e9"))), 5);
}

TEST(TextMask, TheInkIsCentredAndHasTheMeasuredSize) {
    const Lettering text = words("Hxg");
    const Bounds b = bounds(mask(text));
    const InkBox box = ink_box(text);
    EXPECT_NEAR(0.5 * (b.left + b.right + 1), 300, 1.5);
    EXPECT_NEAR(0.5 * (b.top + b.bottom + 1), 120, 1.5);
    EXPECT_NEAR(b.right + 1 - b.left, 100 * double(box.width), 2.5);
    EXPECT_NEAR(b.bottom + 1 - b.top, 100 * double(box.height), 2.5);
}

TEST(TextMask, RightToLeftTextRunsFromTheRight) {
    const Bounds lam = bounds(mask(words("\u05dc"))), word = bounds(mask(words("\u05dc."))),
                 latin = bounds(mask(words("l.")));
    EXPECT_LT(lam.right - lam.left, word.right - word.left);
    const Grid<std::uint8_t> hebrew = mask(words("\u05dc."));
    EXPECT_LT(*std::max_element(hebrew.row(word.top + 2), hebrew.row(word.top + 2) + word.left + 15), 128)
        << "the stop stands left";
    const Grid<std::uint8_t> left = mask(words("l."));
    EXPECT_GE(*std::max_element(left.row(latin.top + 2), left.row(latin.top + 2) + latin.left + 15), 128);
}

TEST(TextMask, LinesSpacingAndAlignmentMatter) {
    const Bounds one = bounds(mask(words("ab"))), two = bounds(mask(words("a\nb")));
    EXPECT_GT(two.bottom - two.top, (one.bottom - one.top) * 3 / 2);
    Lettering wide = words("ab");
    wide.letter_spacing = 0.5f;
    EXPECT_NEAR(bounds(mask(wide)).right - bounds(mask(wide)).left, one.right - one.left + 46, 4);
    Lettering left = words("aaaa\nl"), right = left;
    left.align = Lettering::Align::left;
    right.align = Lettering::Align::right;
    EXPECT_NE(mask(left), mask(right));
}

TEST(TextMask, RefusesWhatItCannotDraw) {
    EXPECT_NE(problem(words("")).find("empty"), std::string::npos);
    EXPECT_NE(problem(words(" \n ")).find("empty"), std::string::npos);
    EXPECT_NE(problem(words("\xff\xfe")).find("UTF-8"), std::string::npos);
    EXPECT_NE(problem(words("a\U0001FBFF\uE123")).find("U+"), std::string::npos) << "no font has it";
    Lettering unknown = words("a");
    unknown.font = "No Such Typeface Bold";
    EXPECT_NE(problem(unknown).find("No Such Typeface"), std::string::npos);
    EXPECT_EQ(problem(words("plain")), "");
}

}  // namespace
}  // namespace dstylize
