#include "pipeline/output_size.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"

namespace dstylize {
namespace {

TEST(OutputSize, ItsTextGivesItAgain) {
    for (const char* text :
         {"2400", "150%", "33.5%", "30cm@300dpi", "297mm", "12in@600dpi", "1.5m@72", "A3", "letter@150dpi"}) {
        const OutputSize size = parsed_output_size(text), again = parsed_output_size(output_size_text(size));
        EXPECT_EQ(again.kind, size.kind) << text;
        EXPECT_EQ(again.value, size.value) << text;
        EXPECT_EQ(again.dpi, size.dpi) << text;
        EXPECT_EQ(again.paper, size.paper) << text;
    }
    EXPECT_EQ(output_size_text({}), "");
}

TEST(OutputSize, APaperHoldsThePictureAsLargeAsItCan) {
    const OutputSize a4 = parsed_output_size("A4");
    for (const Extent picture : {Extent{100, 100}, Extent{3000, 200}, Extent{210, 297}, Extent{50, 4000}}) {
        const OutputFrame frame = output_frame(a4, picture);
        const double longer = std::max(frame.width_mm, frame.height_mm),
                     shorter = std::min(frame.width_mm, frame.height_mm);
        EXPECT_LE(longer, 297.001);
        EXPECT_LE(shorter, 210.001);
        EXPECT_TRUE(longer > 296.999 || shorter > 209.999);
        EXPECT_EQ(frame.width_mm > frame.height_mm, picture.x > picture.y);
    }
}

TEST(OutputSize, EverySideHasAPixel) {
    EXPECT_EQ(output_frame(parsed_output_size("1"), {4000, 1}).size_px, (Extent{1, 1}));
    EXPECT_EQ(output_frame(parsed_output_size("10"), {1, 4000}).size_px, (Extent{1, 10}));
}

TEST(OutputSize, NonsenseIsWrongUsage) {
    for (const char* text : {"", "-5", "0", "nan", "inf", "1e9e", "10.5", "5 cm", "cm", "A11", "30cm@", "30cm@0",
                             "2400@300dpi", "50%@300dpi", "30cm@300ppi"}) {
        try {
            parsed_output_size(text);
            ADD_FAILURE() << text;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::bad_usage) << text;
        }
    }
    EXPECT_THROW(output_frame(parsed_output_size("70000"), {10, 10}), Error);
}

}  // namespace
}  // namespace dstylize
