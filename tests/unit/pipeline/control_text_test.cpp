#include "pipeline/control_text.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace dstylize {
namespace {

TEST(RootText, ItGivesTheRootAgain) {
    for (const char* text : {"bottom", "darkest", "0.5,0.25", "320,450", "0.0,17", "1.0,1.0"})
        EXPECT_EQ(root_text(parsed_root(text)), text);
    const RootChoice mixed = parsed_root("0.5,12");
    EXPECT_TRUE(mixed.x.is_fraction);
    EXPECT_FALSE(mixed.y.is_fraction);
    EXPECT_EQ(mixed.x.px(300), 150);
    EXPECT_EQ(mixed.y.px(300), 12.5) << "a pixel is meant by its centre";
    for (const char* text : {"", "left", "1", "1,", ",1", "1,2,3", "a,b", "nan,0.5", "0x10,3"})
        EXPECT_THROW(parsed_root(text), Error) << text;
}

TEST(EndpointRows, BlanksCommentsAndAHeadingAreSkipped) {
    const auto rows = endpoint_rows("# mine\r\nx, y, stage\r\n\r\n 0.5 , 10\r\n3,4, tone \n", "ends.csv");
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0].x.value, 0.5);
    EXPECT_EQ(rows[0].stage, "");
    EXPECT_EQ(rows[1].y.value, 4);
    EXPECT_EQ(rows[1].stage, "tone");
}

TEST(EndpointRows, TheFirstBadLineIsNamed) {
    for (const char* text : {"1,2\n3\n", "1,2\n3,4,tone,more\n", "1,2\n;\n", "1,2\nx,y\n", "1,2\n1e400,3\n"}) {
        try {
            endpoint_rows(text, "ends.csv");
            ADD_FAILURE() << text;
        } catch (const Error& error) {
            EXPECT_EQ(error.file(), "ends.csv:2") << text;
            EXPECT_EQ(error.code(), ErrorCode::cannot_read);
        }
    }
    EXPECT_THROW(endpoint_rows("x,y\n", "ends.csv"), Error);
}

TEST(CheckEndpoints, TheLastPixelIsInsideTheNextIsNot) {
    const auto check = [](const char* text) { check_endpoints(endpoint_rows(text, "f"), {100, 50}, {"growth"}, "f"); };
    EXPECT_NO_THROW(check("99,49\n1.0,1.0,growth\n"));
    EXPECT_THROW(check("100,0\n"), Error);
    EXPECT_THROW(check("0,-1\n"), Error);
    EXPECT_THROW(check("1.01,0.5\n"), Error);
    EXPECT_THROW(check("0.5,0.5,leaf\n"), Error);
}

TEST(Colour, OnlySixDigitsAreOne) {
    EXPECT_EQ(parsed_colour("#ff8000"), (Rgba{1, 128 / 255.0f, 0, 1}));
    EXPECT_EQ(colour_text(*parsed_colour("#0A0b0c")), "#0a0b0c");
    for (const char* text : {"", "#fff", "ff8000", "#gg0000", "#ff80001", "#-12345"})
        EXPECT_FALSE(parsed_colour(text)) << text;
}

}  // namespace
}  // namespace dstylize
