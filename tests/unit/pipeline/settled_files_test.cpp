#include "pipeline/settled_files.h"

#include <gtest/gtest.h>

#include <chrono>

namespace dstylize {
namespace {

using Names = std::set<std::filesystem::path>;

FileState state(std::uintmax_t bytes, int second) {
    return {bytes, std::filesystem::file_time_type(std::chrono::seconds(second))};
}

TEST(SettledFiles, AreToldOnceWhenTwoFurtherLooksFindThemUnchanged) {
    SettledFiles settled;
    EXPECT_EQ(settled.after_look({{"a", state(5, 1)}}), Names{});
    EXPECT_EQ(settled.after_look({{"a", state(5, 1)}}), Names{});
    EXPECT_EQ(settled.after_look({{"a", state(5, 1)}, {"b", state(7, 1)}}), Names{"a"});
    EXPECT_EQ(settled.after_look({{"a", state(5, 1)}, {"b", state(7, 1)}}), Names{});
    EXPECT_EQ(settled.after_look({{"a", state(5, 1)}, {"b", state(7, 1)}}), Names{"b"});
    for (int look = 0; look < 5; ++look) EXPECT_EQ(settled.after_look({{"a", state(5, 1)}}), Names{});
}

TEST(SettledFiles, AreNotThoseThatGrowOrAreWrittenOrAreEmpty) {
    SettledFiles settled;
    for (int look = 0; look < 9; ++look)
        EXPECT_EQ(settled.after_look(
                      {{"grows", state(5 + look / 2, 1)}, {"written", state(5, look / 2)}, {"empty", state(0, 1)}}),
                  Names{});
}

TEST(SettledFiles, AreToldAgainWhenTheyHaveChangedOrComeBack) {
    SettledFiles settled;
    const auto looks = [&](int times, const FileStates& now) {
        Names told;
        for (int look = 0; look < times; ++look) told.merge(settled.after_look(now));
        return told;
    };
    EXPECT_EQ(looks(3, {{"a", state(5, 1)}}), Names{"a"});
    EXPECT_EQ(looks(2, {{"a", state(5, 2)}}), Names{});
    EXPECT_EQ(looks(1, {{"a", state(5, 2)}}), Names{"a"});
    EXPECT_EQ(looks(2, {}), Names{});
    EXPECT_EQ(looks(3, {{"a", state(5, 2)}}), Names{"a"});
}

}  // namespace
}  // namespace dstylize
