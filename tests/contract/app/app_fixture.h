#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "support/picture_files.h"
#include "support/process.h"
#include "support/scenes.h"
#include "support/temp_folder.h"
#include "unit/formats/picture_files.h"

namespace dstylize::test {

using Words = std::vector<std::string>;

/// Without the codec, whose start takes longer than most of what these tests do.
inline void write_png(const std::filesystem::path& path, const Picture& picture) {
    const PngHeader header{std::uint32_t(picture.extent().x), std::uint32_t(picture.extent().y), 8, 6};
    const auto* const bytes = reinterpret_cast<const char*>(picture.data());
    write_file(path, png_file(header, {bytes, picture.extent().count() * sizeof(Rgba8)}));
}

/// A folder with a picture in.png, in which dstylize runs.
class AppTest : public ::testing::Test {
  protected:
    static constexpr Extent kSize{96, 64};

    AppTest() { write_png(folder_ / "in.png", scene(kSize)); }

    Outcome run(const Words& words, std::string_view input = "") const {
        return dstylize(words, folder_.path(), input);
    }
    /// The same with a style that is fast.
    Outcome draw(Words words, std::string_view input = "") const {
        words.insert(words.end(), {"--style", "ink", "--detail", "64"});
        return run(words, input);
    }

    TempFolder folder_;
};

/// An error is one line of three parts, from us, and says `parts`.
inline void expect_error(const Outcome& outcome, int exit_code, const Words& parts) {
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_TRUE(outcome.err.starts_with("dstylize: ")) << outcome.err;
    EXPECT_TRUE(outcome.err.ends_with("\n")) << outcome.err;
    for (const std::string& part : parts)
        EXPECT_NE(outcome.err.find(part), std::string::npos) << part << "\n" << outcome.err;
    EXPECT_EQ(outcome.out, "");
}

inline void expect_done(const Outcome& outcome) {
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
}

}  // namespace dstylize::test
