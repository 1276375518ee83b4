// One folder, drawn in shares that know nothing of each other: as one run would have drawn it.
#include "contract/app/folder_fixture.h"

namespace dstylize::test {
namespace {

namespace fs = std::filesystem;

class ShardsTest : public FolderTest {
  protected:
    ShardsTest() {
        for (int k = 0; k < 4; ++k) write_png(folder_ / "photos" / (std::to_string(k) + ".png"), scene({70 + k, 60}));
        write_file(folder_ / "photos/bad.jpg", std::string_view("no JPEG"));
    }
    Outcome draw_shard(const std::string& shard, Words more = {}, const std::string& out = "out") const {
        Words words{"photos", out, "--manifest", "list", "--shard", shard};
        words.insert(words.end(), more.begin(), more.end());
        return draw(words);
    }
    Outcome merge() const { return run({"merge-reports", "out"}); }
};

TEST_F(ShardsTest, MergeIntoWhatOneMachineWouldHaveMade) {
    const Outcome whole = draw({"photos", "whole"});
    EXPECT_EQ(whole.exit_code, 5);
    std::size_t drawn = 0;
    for (const char* shard : {"3/3", "1/3", "2/3"}) {
        const std::size_t before = results(folder_ / "out").size();
        const Outcome outcome = draw_shard(shard);
        EXPECT_EQ(outcome.exit_code, outcome.err.empty() ? 0 : 5);
        EXPECT_FALSE(fs::exists(folder_ / "out/report.json"));
        const std::size_t now = results(folder_ / "out").size();
        EXPECT_GE(now - before, 1u);
        drawn += now - before;
    }
    EXPECT_EQ(drawn, 7u);
    const Outcome merged = merge();
    EXPECT_EQ(merged.exit_code, 5) << merged.err;
    EXPECT_NE(merged.out.find("failed       bad.jpg"), std::string::npos) << merged.out;
    EXPECT_TRUE(results(folder_ / "out") == results(folder_ / "whole"));
    for (const char* file : {"report.json", "index.html"})
        EXPECT_EQ(file_bytes(folder_ / "out" / file), file_bytes(folder_ / "whole" / file)) << file;
    EXPECT_EQ(merge().exit_code, 5) << "once more is the same";
}

TEST_F(ShardsTest, DrawNothingTwiceInWhateverSharesItIsDone) {
    for (const char* shard : {"1/2", "2/2"}) draw_shard(shard);
    const auto drawn_at = fs::last_write_time(folder_ / "out/a.png");
    draw_shard("1/2");
    draw_shard("2/2");
    merge();
    for (const auto& [picture, state] : states()) EXPECT_EQ(state, picture == "bad.jpg" ? "failed" : "up to date");
    fs::remove_all(folder_ / "out/.dstylize/shards");
    for (const char* shard : {"1/3", "2/3", "3/3"}) draw_shard(shard);
    merge();
    draw_all();
    for (const auto& [picture, state] : states()) EXPECT_EQ(state, picture == "bad.jpg" ? "failed" : "up to date");
    EXPECT_EQ(fs::last_write_time(folder_ / "out/a.png"), drawn_at);
    EXPECT_FALSE(fs::exists(folder_ / "out/.dstylize/shards")) << "the whole run took them over";
}

TEST_F(ShardsTest, KeepToTheFrozenManifest) {
    draw_shard("1/2");
    const std::string frozen = file_bytes(folder_ / "list");
    write_png(folder_ / "photos/00.png", scene({30, 30}));
    fs::remove(folder_ / "photos/3.png");
    const Outcome outcome = draw_shard("2/2");
    EXPECT_EQ(file_bytes(folder_ / "list"), frozen);
    merge();
    EXPECT_FALSE(states().contains("00.png"));
    EXPECT_EQ(states()["3.png"], "failed") << outcome.err;
    EXPECT_EQ(states().size(), 8u);
}

TEST_F(ShardsTest, CanBeMoreThanThePictures) {
    for (int k = 1; k <= 9; ++k) draw_shard(std::to_string(k) + "/9");
    EXPECT_EQ(merge().exit_code, 5);
    EXPECT_EQ(states().size(), 8u);
}

TEST_F(ShardsTest, AreNotMergedUnlessAllAreThereAndOfOneRun) {
    expect_error(merge(), 3, {"out", "no reports", "--shard"});
    draw_shard("1/3");
    expect_error(merge(), 3, {"no report of shard 2,3 of 3", "sbatch --array=2,3"});
    draw_shard("2/3");
    draw_shard("3/3", {"--seed", "2"});
    expect_error(merge(), 3, {"3.json", "another run"});
    draw_shard("3/3");
    write_file(folder_ / "out/.dstylize/shards/3/2.json", std::string_view("{\"pictures\": ["));
    expect_error(merge(), 3, {"2.json", "run shard 2/3 again"});
    draw_shard("2/3");
    draw_shard("1/2");
    expect_error(merge(), 3, {"shards", "different numbers"});
    EXPECT_FALSE(fs::exists(folder_ / "out/report.json"));
}

TEST_F(ShardsTest, AreTakenOverFromNoOtherFolder) {
    fs::create_directories(folder_ / "elsewhere/shards/2");
    fs::create_directories(folder_ / "out");
    fs::create_directory_symlink("../elsewhere", folder_ / "out/.dstylize");
    write_file(folder_ / "elsewhere/manifest", std::string_view("precious"));
    for (const Outcome& outcome : {draw_all(), draw_shard("1/2"), draw({"sbatch", "photos", "out", "--nodes", "2"})})
        expect_error(outcome, 4, {"out/.dstylize", "a link leads out"});
    EXPECT_TRUE(fs::exists(folder_ / "elsewhere/shards/2"));
    EXPECT_TRUE(fs::is_empty(folder_ / "elsewhere/shards/2"));
    EXPECT_EQ(file_bytes(folder_ / "elsewhere/manifest"), "precious");
    EXPECT_FALSE(fs::exists(folder_ / "elsewhere/slurm"));
}

TEST_F(ShardsTest, TouchNothingBehindALink) {
    fs::create_directories(folder_ / "elsewhere/2");
    fs::create_directories(folder_ / "out/.dstylize");
    write_file(folder_ / "elsewhere/2/1.json", std::string_view("precious"));
    fs::create_directory_symlink("../../elsewhere", folder_ / "out/.dstylize/shards");
    expect_error(draw_shard("1/2"), 4, {"a link leads out"});
    EXPECT_EQ(file_bytes(folder_ / "elsewhere/2/1.json"), "precious");

    fs::remove(folder_ / "out/.dstylize/shards");
    fs::remove(folder_ / "out/.dstylize");
    fs::create_directory(folder_ / "nothing");
    fs::create_directory_symlink("../nothing", folder_ / "out/.dstylize");
    expect_error(draw_shard("1/2"), 4, {"a link leads out"});
    EXPECT_TRUE(fs::is_empty(folder_ / "nothing"));

    fs::remove(folder_ / "out/.dstylize");
    draw_shard("1/1");
    fs::rename(folder_ / "out/.dstylize", folder_ / "moved");
    fs::create_directory_symlink("../moved", folder_ / "out/.dstylize");
    fs::remove(folder_ / "moved/ledger.jsonl");
    expect_error(run({"merge-reports", "out"}), 4, {"a link leads out"});
    EXPECT_FALSE(fs::exists(folder_ / "moved/ledger.jsonl"));
}

TEST_F(ShardsTest, RefuseWrongUsageAndManifestsThatAreNotWhole) {
    expect_error(draw({"photos", "out", "--shard", "1/2"}), 2, {"--shard 1/2", "--manifest"});
    for (const char* shard : {"0/2", "3/2", "1", "1/0", "a/b", "1/2x"})
        expect_error(draw_shard(shard), 2, {shard, "K/N"});
    expect_error(draw({"in.png", "x.png", "--shard", "1/2"}), 2, {"in.png", "--shard"});
    for (const char* text :
         {"", "a.png\n", "# dstylize manifest 1, pictures: 2\na.png\n", "# dstylize manifest 1, pictures: 1\na.png",
          "# dstylize manifest 1, pictures: 1\n../in.png\n", "# dstylize manifest 1, pictures: 2\na.png\na.png\n"}) {
        write_file(folder_ / "list", std::string_view(text));
        expect_error(draw_shard("1/1"), 3, {"list: "});
    }
    EXPECT_FALSE(fs::exists(folder_ / "out"));
}

}  // namespace
}  // namespace dstylize::test
