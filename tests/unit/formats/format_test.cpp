#include "formats/format.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"

namespace dstylize {
namespace {

TEST(Formats, FollowTheExtensionInAnyCase) {
    EXPECT_EQ(format_for("a/b.png").id, FormatId::png);
    EXPECT_EQ(format_for("b.JPG").id, FormatId::jpg);
    EXPECT_EQ(format_for("b.jpeg").id, FormatId::jpg);
    EXPECT_EQ(format_for("b.Tiff").id, FormatId::tif);
    EXPECT_EQ(format_for("b.c.svg").id, FormatId::svg);
    EXPECT_EQ(format_for("b.c.svg").holds, Holds::display_list);
    EXPECT_EQ(format_for("b.json").holds, Holds::skeleton);
    EXPECT_EQ(format_for("b.webp").holds, Holds::picture);
    EXPECT_FALSE(format_for("b.jpg").alpha);
    EXPECT_TRUE(format_for("b.png").alpha);
}

TEST(Formats, EveryNameAndExtensionIsFoundAndOnlyOnce) {
    EXPECT_EQ(output_formats().size(), 7u);
    for (const OutputFormat& format : output_formats()) {
        EXPECT_EQ(&format_named(format.name), &format);
        for (const std::string_view extension : format.extensions) EXPECT_EQ(&format_named(extension), &format);
    }
}

TEST(Formats, UnknownOnesAreBadUsageAndNameTheKnown) {
    for (const char* path : {"a.gif", "a", "a.", "dir.png/a", ".png", "a.p", "a.png "}) {
        try {
            format_for(path);
            ADD_FAILURE() << path << " was taken";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::bad_usage);
            EXPECT_EQ(error.file(), path);
            EXPECT_NE(error.remedy().find("png, jpg, jpeg, tif, tiff, webp, svg, pdf, json"), std::string::npos);
        }
    }
    EXPECT_THROW(format_named(""), Error);
}

}  // namespace
}  // namespace dstylize
