// `dstylize write`: its forms, what it refuses, and that its letters can be read.
#include <sys/stat.h>

#include "contract/app/app_fixture.h"
#include "imaging/filters.h"

namespace dstylize::test {
namespace {

class WriteTest : public AppTest {
  protected:
    /// With few nodes, to be fast.
    Outcome write(Words words) const {
        words.insert(words.begin(), "write");
        words.insert(words.end(), {"--detail", "256"});
        return run(words);
    }
    bool has(const std::string& name) const { return std::filesystem::exists(folder_ / name); }
};

TEST_F(WriteTest, WritesOnPaperOnAPictureAndFromAMask) {
    write_png(folder_ / "mask.png", [] {
        Picture p = flat({90, 60}, {0, 0, 0, 255});
        for (int j = 20; j < 40; ++j)
            for (int i = 20; i < 70; ++i) p(i, j) = {255, 255, 255, 255};
        return p;
    }());
    EXPECT_EQ(write({"Hi", "paper.png"}).exit_code, 0);
    EXPECT_EQ(write({"Hi", "in.png", "on.png"}).exit_code, 0);
    EXPECT_EQ(write({"--mask", "mask.png", "shape.svg"}).exit_code, 0);
    EXPECT_EQ(write({"--mask", "mask.png", "in.png", "on-mask.png"}).exit_code, 0);
    for (const char* name : {"paper.png", "on.png", "shape.svg", "on-mask.png"}) EXPECT_TRUE(has(name)) << name;
    EXPECT_EQ(read_picture(folder_ / "on.png").picture.extent(), kSize);
    EXPECT_EQ(read_picture(folder_ / "paper.png").picture.extent().long_side(), 1600);
}

TEST_F(WriteTest, TheSameCommandGivesTheSameBytes) {
    for (const char* style : {"letters", "lichen-letters"}) {
        ASSERT_EQ(write({"Oi", "a.png", "--style", style, "--no-recipe", "--force"}).exit_code, 0);
        ASSERT_EQ(write({"Oi", "b.png", "--style", style, "--no-recipe", "--force", "--threads", "1"}).exit_code, 0);
        EXPECT_EQ(file_bytes(folder_ / "a.png"), file_bytes(folder_ / "b.png")) << style;
    }
}

TEST_F(WriteTest, OptionsChangeWhatIsWritten) {
    const Words options[] = {{"--font", "DejaVu Serif"}, {"--letter-spacing", "0.4"}, {"--line-spacing", "2"},
                             {"--align", "right"},       {"--text-size", "0.2"},      {"--place", "0.4,0.6"}};
    ASSERT_EQ(write({"ab\\nc", "plain.png", "--no-recipe"}).exit_code, 0);
    for (const Words& option : options) {
        Words words{"ab\\nc", "other.png", "--no-recipe", "--force"};
        words.insert(words.end(), option.begin(), option.end());
        ASSERT_EQ(write(words).exit_code, 0) << option[0];
        EXPECT_NE(file_bytes(folder_ / "other.png"), file_bytes(folder_ / "plain.png")) << option[0];
    }
}

TEST_F(WriteTest, AReplayWritesTheSameWords) {
    ASSERT_EQ(write({"Wo", "in.png", "old.png", "--place", "0.4,0.5"}).exit_code, 0);
    ASSERT_EQ(run({"replay", "old.png", "in.png", "new.png"}).exit_code, 0);
    EXPECT_EQ(read_picture(folder_ / "old.png").picture, read_picture(folder_ / "new.png").picture);
    ASSERT_EQ(write({"Wo", "paper.png"}).exit_code, 0);
    const Outcome again = run({"replay", "paper.png", "again.png"});
    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(read_picture(folder_ / "paper.png").picture, read_picture(folder_ / "again.png").picture);
}

TEST_F(WriteTest, RefusesWithOneLine) {
    write_png(folder_ / "black.png", flat({30, 20}, {0, 0, 0, 255}));
    expect_error(write({"", "out.png"}), 2, {"the text is empty"});
    expect_error(write({"  ", "out.png"}), 2, {"the text is empty"});
    expect_error(write({"\xff", "out.png"}), 2, {"UTF-8"});
    expect_error(write({"a\uE123", "out.png"}), 2, {"U+E123", "--font"});
    expect_error(write({"a", "out.png", "--font", "No Such Typeface"}), 2, {"No Such Typeface", "fc-list"});
    expect_error(write({"--mask", "black.png", "out.png"}), 1, {"black.png", "mask"});
    expect_error(write({"a", "in.png", "out.png", "--place", "7.0,0.5"}), 2, {"outside the picture"});
    expect_error(write({"a", "out.png", "--place", "bottom"}), 2, {"--place"});
    expect_error(write({"a"}), 2, {"no output"});
    expect_error(write({"a", "in.png", "out.png", "more.png"}), 2, {"more.png"});
    EXPECT_FALSE(has("out.png"));
}

TEST_F(WriteTest, OcrReadsTheDefaultLetters) {
    const std::string reader = "/usr/bin/tesseract";
    struct stat status {};
    if (::stat(reader.c_str(), &status) != 0) GTEST_SKIP() << "tesseract is not installed (tesseract-ocr)";
    for (const char* font : {"DejaVu Sans", "DejaVu Serif", "DejaVu Sans Bold"}) {
        ASSERT_EQ(run({"write", "water", "word.png", "--font", font, "--force"}).exit_code, 0);
        const Picture word = read_picture(folder_ / "word.png").picture;
        write_png(folder_ / "small.png", resized(word, {word.extent().x / 4, word.extent().y / 4}));
        Process process({reader, "small.png", "-", "--psm", "7"}, folder_.path());
        process.wait();
        EXPECT_TRUE(process.out().starts_with("water")) << font << ": " << process.out();
    }
}

}  // namespace
}  // namespace dstylize::test
