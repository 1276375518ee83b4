// The words of the progress line; that it appears on a terminal only is seen by eye.
#include "app/progress_text.h"

#include <gtest/gtest.h>

namespace dstylize::app {
namespace {

TEST(ProgressText, SaysWhatIsDoneAndWhatIsLeft) {
    EXPECT_EQ(progress_text("3 of 10 pictures", 0.3, 70), "3 of 10 pictures · 30 % · 70 s left");
    EXPECT_EQ(progress_text("tone: paths", 0.5, 119), "tone: paths · 50 % · 119 s left");
    EXPECT_EQ(progress_text("tone: paths", 0.5, 120), "tone: paths · 50 % · 2 min left");
    EXPECT_EQ(progress_text("tone: paths", 0.5, 7200), "tone: paths · 50 % · 2 h left");
    EXPECT_EQ(progress_text("writing", 0.98, 0.4), "writing · 98 %");
    EXPECT_EQ(progress_text(std::string(80, 'x'), 0, 0), std::string(50, 'x') + " · 0 %");
}

TEST(ProgressText, TimeLeftIsTakenFromTimeGone) {
    EXPECT_DOUBLE_EQ(seconds_left(0.25, 20), 60);
    EXPECT_DOUBLE_EQ(seconds_left(0.01, 100), 9900) << "long runs tell early";
    EXPECT_EQ(seconds_left(0.04, 2), 0) << "too little to tell";
    EXPECT_EQ(seconds_left(0, 1000), 0);
    EXPECT_DOUBLE_EQ(seconds_left(1, 20), 0);
}

}  // namespace
}  // namespace dstylize::app
