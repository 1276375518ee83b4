// A folder of pictures as one run.
#include <signal.h>

#include <chrono>
#include <fstream>
#include <regex>
#include <thread>

#include "contract/app/folder_fixture.h"
#include "support/sanitized.h"
#include "unit/formats/picture_files.h"

namespace dstylize::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

TEST_F(FolderTest, IsMirroredWithAReportAndAContactSheet) {
    const Outcome outcome = draw_all();
    expect_done(outcome);
    EXPECT_NE(outcome.out.find("drawn             3"), std::string::npos) << outcome.out;
    EXPECT_EQ(read_picture(folder_ / "out/a.png").picture.extent(), kSize);
    EXPECT_EQ(read_picture(folder_ / "out/sea/b.png").picture.extent(), (Extent{64, 80}));
    EXPECT_TRUE(fs::exists(folder_ / "out/sea/deep/c d&.png"));
    EXPECT_FALSE(fs::exists(folder_ / "out/notes.png"));
    EXPECT_EQ(states(), (std::map<std::string, std::string>{
                            {"a.png", "done"}, {"sea/b.png", "done"}, {"sea/deep/c d&.png", "done"}}));
    const std::string page = file_bytes(folder_ / "out/index.html");
    EXPECT_NE(page.find("href=\"../photos/sea/deep/c%20d%26.png\""), std::string::npos);
    EXPECT_NE(page.find("href=\"sea/deep/c%20d%26.png\""), std::string::npos);
    for (const char* when : {"before", "after"}) {
        const std::string small = std::string(".dstylize/thumbnails/a.") + when + ".jpg";
        EXPECT_NE(page.find("src=\"" + small + "\""), std::string::npos);
        EXPECT_EQ(read_picture(folder_ / "out" / small).picture.extent(), kSize);
    }
    EXPECT_NE(page.find("c d&amp;.png"), std::string::npos);
}

TEST_F(FolderTest, DrawsWhatNeedsMoreMemoryThanItsShareAlone) {
    if (kSanitized) GTEST_SKIP() << "a sanitizer takes several times the memory";
    constexpr int kSide = 13'000;
    PngHeader header{kSide, kSide, 1, 0};
    write_file(folder_ / "photos/large.png", png_file(header, std::string((kSide + 7) / 8 * kSide, '\x55')));
    expect_error(draw({"photos/large.png", "alone.png", "--size", "100", "--max-memory", "1G"}), 3,
                 {"large.png", "--max-memory"});
    expect_done(draw_all({"--size", "100", "--max-memory", "2G", "--threads", "2"}));
    EXPECT_EQ(states()["large.png"], "done");
}

TEST_F(FolderTest, IsDrawnOnceAndAgainOnlyWhereSomethingChanged) {
    expect_done(draw_all());
    const auto drawn_at = fs::last_write_time(folder_ / "out/a.png");
    const auto before = file_bytes(folder_ / "out/sea/b.png");
    expect_done(draw_all());
    EXPECT_EQ(states()["a.png"], "up to date");
    EXPECT_EQ(fs::last_write_time(folder_ / "out/a.png"), drawn_at);

    write_png(folder_ / "photos/a.png", scene({80, 60}));           // another picture
    fs::resize_file(folder_ / "out/sea/b.png", before.size() / 2);  // half a result
    expect_done(draw_all());
    EXPECT_EQ(states()["a.png"], "done");
    EXPECT_EQ(states()["sea/b.png"], "done");
    EXPECT_EQ(states()["sea/deep/c d&.png"], "up to date");
    EXPECT_TRUE(file_bytes(folder_ / "out/sea/b.png") == before);

    Words now{"photos", "out", "--style", "ink"};
    write_png(folder_ / "mask.png", flat({8, 8}, {255, 255, 255, 255}));
    for (const Words& more : {Words{"--detail", "60"}, Words{"--set", "width.widest=3"}, Words{"--seed", "2"},
                              Words{"--mask", "mask.png"}, Words{"--quality", "90"}, Words{"--size", "50"}}) {
        now.insert(now.end(), more.begin(), more.end());
        expect_done(run(now));
        for (const auto& [picture, state] : states()) EXPECT_EQ(state, "done") << more[0] << " " << picture;
    }
    write_png(folder_ / "mask.png", flat({9, 9}, {255, 255, 255, 255}));
    expect_done(run(now));
    EXPECT_EQ(states()["a.png"], "done") << "the mask's content counts, not its name";
}

TEST_F(FolderTest, GoesOnPastBadPicturesAndNamesThem) {
    std::ofstream(folder_ / "photos/sea/bad.jpg") << "no JPEG";
    const Outcome outcome = draw_all();
    EXPECT_EQ(outcome.exit_code, 5);
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_NE(outcome.err.find("photos/sea/bad.jpg"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.out.find("failed            1"), std::string::npos) << outcome.out;
    EXPECT_EQ(states()["sea/bad.jpg"], "failed");
    EXPECT_EQ(states()["sea/deep/c d&.png"], "done");
    EXPECT_FALSE(fs::exists(folder_ / "out/sea/bad.png"));
    const std::string page = file_bytes(folder_ / "out/index.html");
    EXPECT_LT(page.find("sea/bad.jpg"), page.find("href=\"a.png\"")) << "what failed comes first";
}

TEST_F(FolderTest, GivesTheSameBytesOnAnyThreadsAndWhateverElseIsThere) {
    expect_done(draw_all({"--threads", "1"}));
    fs::remove_all(folder_ / "photos/sea/deep");
    write_png(folder_ / "photos/0.png", scene({50, 50}));
    expect_done(draw({"photos", "other", "--threads", "3"}));
    for (const char* name : {"a.png", "sea/b.png"})
        EXPECT_TRUE(file_bytes(folder_ / "out" / name) == file_bytes(folder_ / "other" / name)) << name;
    write_png(folder_ / "photos/sea/a.png", scene(kSize));
    expect_done(draw({"photos", "other"}));
    EXPECT_FALSE(file_bytes(folder_ / "other/a.png") == file_bytes(folder_ / "other/sea/a.png"))
        << "each picture has a seed of its own";
}

TEST_F(FolderTest, TakesPatternsAndFormats) {
    write_picture(folder_ / "photos/sea/a.tif", scene({30, 30}));
    expect_done(draw_all({"--include", "a.*", "--include", "sea/deep/*", "--format", "json"}));
    EXPECT_EQ(states(), (std::map<std::string, std::string>{
                            {"a.png", "done"}, {"sea/a.tif", "done"}, {"sea/deep/c d&.png", "done"}}));
    EXPECT_TRUE(fs::exists(folder_ / "out/sea/a.json"));
}

TEST_F(FolderTest, WritesEveryPictureInSeveralFormatsFromOneDrawing) {
    expect_done(draw_all());
    const auto drawn = file_bytes(folder_ / "out/a.png");
    const auto drawn_at = fs::last_write_time(folder_ / "out/a.png");
    for (const char* state : {"done", "up to date"}) {
        expect_done(draw_all({"--format", "png", "--format", "svg"}));
        for (const auto& [picture, was] : states()) EXPECT_EQ(was, state) << picture;
    }
    EXPECT_EQ(fs::last_write_time(folder_ / "out/a.png"), drawn_at) << "it was up to date";
    EXPECT_TRUE(file_bytes(folder_ / "out/a.svg").starts_with("<?xml"));
    EXPECT_NE(file_bytes(folder_ / "out/index.html").find("href=\"a.svg\""), std::string::npos);
    expect_done(draw({"photos", "both", "--format", "svg", "--format", "png"}));
    EXPECT_TRUE(file_bytes(folder_ / "both/a.png") == drawn) << "what else is written changes nothing";
    write_file(folder_ / "out/a.json", std::string_view("somebody's"));
    EXPECT_EQ(draw_all({"--format", "png", "--format", "json", "--seed", "2"}).exit_code, 5);
    EXPECT_EQ(file_bytes(folder_ / "out/a.json"), "somebody's");
    expect_error(draw_all({"--format", "jpg", "--format", "jpeg"}), 2, {"--format jpeg", "twice"});
    expect_error(draw({"in.png", "x", "--format", "png", "--format", "svg"}), 2, {"--format svg", "-o"});
}

TEST_F(FolderTest, NamesTheDrawingsAsATemplateSays) {
    write_picture(folder_ / "photos/a.tif", scene({30, 30}));
    expect_done(draw_all({"--name", "{style}/{stem}-{seed}", "--seed", "7"}));
    for (const char* name : {"ink/a.png-7.png", "ink/a.tif-7.png", "sea/ink/b-7.png", "sea/deep/ink/c d&-7.png"})
        EXPECT_TRUE(fs::exists(folder_ / "out" / name)) << name;
    expect_error(draw_all({"--name", "{style}"}), 2, {"--name {style}", "{stem}"});
    expect_error(draw_all({"--name", "{stem}{x}"}), 2, {"{x}", "no field"});
    expect_error(draw_all({"--name", "../{stem}"}), 2, {"leads out"});
    expect_error(draw({"in.png", "x.png", "--name", "{stem}-1"}), 2, {"in.png", "--name"});
}

TEST_F(FolderTest, GivesEachOfSeveralStylesAFolder) {
    std::ofstream(folder_ / "mine.toml") << "[style]\nname = \"mine\"\nextends = \"ink\"\n[width]\nwidest = 9.0\n";
    for (const char* state : {"done", "up to date"}) {
        const Outcome outcome = draw({"photos", "photos/out", "--style", "./mine.toml", "--json"});
        expect_done({outcome.exit_code, "", outcome.err});
        const json reports = json::parse(outcome.out);
        ASSERT_EQ(reports.size(), 2u);
        EXPECT_EQ(reports[0]["style"], "mine");
        EXPECT_EQ(reports[1][state], 3);
    }
    EXPECT_FALSE(file_bytes(folder_ / "photos/out/mine/a.png") == file_bytes(folder_ / "photos/out/ink/a.png"));
    expect_error(draw({"photos", "photos", "--style", "vine"}), 2, {"photos", "also the input"});
    expect_error(draw({"photos", "--style", "vine"}), 2, {"photos", "give OUT"});
    expect_error(draw({"photos", "in.png", "--style", "vine"}), 2, {"in.png", "is a file"});
    expect_error(draw({"photos", "two", "--style", "ink"}), 2, {"--style ink", "twice"});
    expect_error(draw({"in.png", "two.png", "--style", "vine"}), 2, {"--style ink", "folders"});
}

TEST_F(FolderTest, KeepsTheExtensionsOfPicturesWhoseResultsWouldBeOne) {
    write_picture(folder_ / "photos/a.tif", scene({30, 30}));
    expect_done(draw_all());
    EXPECT_EQ(read_picture(folder_ / "out/a.tif.png").picture.extent(), (Extent{30, 30}));
    EXPECT_EQ(read_picture(folder_ / "out/a.png.png").picture.extent(), kSize);
    EXPECT_FALSE(fs::exists(folder_ / "out/a.png"));
}

TEST_F(FolderTest, LeavesItsOwnResultsAndWhatIsHiddenOutOfTheInput) {
    fs::create_directories(folder_ / "photos/.cache");
    write_png(folder_ / "photos/.cache/x.png", scene({30, 30}));
    fs::create_directory_symlink("..", folder_ / "photos/sea/loop");
    for (int times = 0; times < 2; ++times) expect_done(draw({"photos", "photos/drawn"}));
    EXPECT_EQ(states("photos/drawn").size(), 3u);
}

TEST_F(FolderTest, KilledAtAnyMomentEndsAsIfItHadNotBeen) {
    for (int k = 0; k < 6; ++k) write_png(folder_ / "photos" / (std::to_string(k) + ".png"), scene({70 + k, 60}));
    expect_done(draw({"photos", "whole"}));
    const auto whole = results(folder_ / "whole");
    ASSERT_EQ(whole.size(), 9u);
    std::size_t interrupted = 0;
    for (int wait_ms = 150; wait_ms <= 900; wait_ms += 150) {
        Process process({DSTYLIZE_PROGRAM, "photos", "out", "--style", "ink", "--detail", "64"}, folder_.path());
        std::this_thread::sleep_for(std::chrono::milliseconds(wait_ms));
        process.send(SIGKILL);
        process.wait();
        for (const auto& [name, content] : results(folder_ / "out"))
            EXPECT_TRUE(whole.at(name) == content) << name << " after " << wait_ms << " ms";
        interrupted += results(folder_ / "out").size() < whole.size();
        if (wait_ms == 450) fs::remove_all(folder_ / "out");
    }
    expect_done(draw_all());
    EXPECT_TRUE(results(folder_ / "out") == whole);
    EXPECT_GT(interrupted, 0u) << "no kill came in the middle";
}

TEST_F(FolderTest, KeepsPicturesApartFromItsOwnReport) {
    write_png(folder_ / "photos/report.png", scene({30, 30}));
    expect_done(draw_all({"--format", "json"}));
    EXPECT_EQ(json::parse(std::ifstream(folder_ / "out/report.png.json"))["format"], "dstylize skeleton");
    EXPECT_EQ(states()["report.png"], "done");
}

TEST_F(FolderTest, SaysInADryRunWhatItWouldDoAndDoesNothing) {
    const Outcome outcome = draw_all({"--dry-run"});
    expect_done(outcome);
    EXPECT_NE(outcome.out.find("to be drawn       3"), std::string::npos) << outcome.out;
    EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(FolderTest, LeavesADrawingThatWasRetouched) {
    expect_done(draw_all());
    write_png(folder_ / "out/a.png", scene({30, 20}));
    const std::string retouched = file_bytes(folder_ / "out/a.png");
    const Outcome outcome = draw_all();
    EXPECT_EQ(outcome.exit_code, 5);
    EXPECT_TRUE(outcome.err.starts_with("dstylize: photos/a.png: out/a.png: exists and was not made")) << outcome.err;
    EXPECT_TRUE(file_bytes(folder_ / "out/a.png") == retouched);
    expect_done(draw_all({"--force"}));
    EXPECT_FALSE(file_bytes(folder_ / "out/a.png") == retouched);
}

TEST_F(FolderTest, LeavesPagesAndReportsOfOthers) {
    for (const std::string name : {"index.html", "report.json"}) {
        fs::remove_all(folder_ / "out");
        fs::create_directory(folder_ / "out");
        write_file(folder_ / ("out/" + name), std::string_view("precious"));
        expect_error(draw_all(), 4, {"out/" + name, "was not made by dstylize"});
        EXPECT_EQ(file_bytes(folder_ / ("out/" + name)), "precious");
        EXPECT_FALSE(fs::exists(folder_ / "out/a.png")) << "told before anything is drawn";
        expect_done(draw_all({"--force"}));
    }
}

TEST_F(FolderTest, KeepsThumbnailsWhateverTheFormats) {
    fs::rename(folder_ / "photos/a.png", folder_ / ("photos/" + std::string(246, 'n') + ".png"));
    expect_done(draw_all({"--format", "png", "--format", "jpg"}));
    expect_done(draw_all({"--format", "jpg"}));
    const auto missing = [&] {
        const std::string page = file_bytes(folder_ / "out/index.html");
        int count = 0;
        for (std::size_t at = 0; (at = page.find("src=\"", at)) != std::string::npos;) {
            at += 5;
            const std::string name = page.substr(at, page.find('"', at) - at);
            count += name.find('%') == std::string::npos && !fs::exists(folder_ / "out" / name);
        }
        return count;
    };
    EXPECT_EQ(missing(), 0);
    fs::remove_all(folder_ / "out/.dstylize/thumbnails");
    expect_done(draw_all({"--format", "jpg"}));
    EXPECT_EQ(missing(), 0) << "the pictures themselves stand in";
}

TEST_F(FolderTest, NoStylesNameLeadsOutOfTheFolderOfTheDrawings) {
    for (const std::string name : {"../evil", "/tmp/evil", "..", ".dstylize"}) {
        write_file(folder_ / "own.toml", "[style]\nname = \"" + name + "\"\nextends = \"ink\"\n");
        expect_error(draw({"photos", "out", "--style", "./own.toml", "--style", "ink"}), 2, {"own.toml", name});
    }
    EXPECT_FALSE(fs::exists(folder_ / "evil"));
}

TEST_F(FolderTest, ReplacesNothingThatItDidNotMake) {
    fs::create_directory(folder_ / "out");
    write_png(folder_ / "out/a.png", flat({5, 5}, {1, 2, 3, 255}));
    const auto before = file_bytes(folder_ / "out/a.png");
    EXPECT_EQ(draw_all().exit_code, 5);
    EXPECT_TRUE(file_bytes(folder_ / "out/a.png") == before);
    expect_done(draw_all({"--force"}));
    EXPECT_FALSE(file_bytes(folder_ / "out/a.png") == before);
}

TEST_F(FolderTest, FollowsNoLinkOutOfTheFolderOfTheDrawings) {
    fs::create_directories(folder_ / "out");
    fs::create_directories(folder_ / "elsewhere");
    fs::create_directory_symlink("../elsewhere", folder_ / "out/sea");
    fs::create_symlink("../in.png", folder_ / "out/a.png");
    const auto before = file_bytes(folder_ / "in.png");
    const Outcome outcome = draw_all({"--force"});
    EXPECT_EQ(outcome.exit_code, 5);
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 3) << outcome.err;
    EXPECT_TRUE(file_bytes(folder_ / "in.png") == before);
    EXPECT_TRUE(fs::is_empty(folder_ / "elsewhere"));
}

TEST_F(FolderTest, DrawsIntoNoFolderThatContainsTheInput) {
    // The drawing of sea/sea/b.png would be sea/b.png, an original.
    fs::create_directory(folder_ / "photos/sea/sea");
    write_png(folder_ / "photos/sea/sea/b.png", scene({50, 50}));
    fs::create_directory_symlink("photos/sea", folder_ / "link");
    fs::create_directory_symlink("photos", folder_ / "whole");
    const auto before = results(folder_ / "photos");
    for (const Words& folders : {Words{"photos/sea", "photos"}, Words{"photos/sea/deep", "photos/"},
                                 Words{"photos/sea", "whole"}, Words{"link", "photos"}, Words{"photos", "."}})
        for (const Words& more : {Words{}, Words{"--style", "vine"}, Words{"--dry-run"}}) {
            Words words{folders[0], folders[1], "--force"};
            words.insert(words.end(), more.begin(), more.end());
            expect_error(draw(words), 2, {folders[1] + ": contains the input, " + folders[0]});
        }
    expect_error(draw({"sbatch", "photos/sea", "photos", "--nodes", "2"}), 2, {"photos: contains the input"});
    EXPECT_TRUE(results(folder_ / "photos") == before);
    EXPECT_FALSE(fs::exists(folder_ / "photos/.dstylize"));
    expect_done(draw({"photos", "photos2"}));
    expect_done(draw({"link", "photos3"}));
}

TEST_F(FolderTest, TellsOfEveryPictureWhenVerbose) {
    write_file(folder_ / "photos/bad.png", std::string_view("no PNG"));
    const Outcome drawn = draw_all({"--verbose", "--threads", "2"});
    EXPECT_EQ(drawn.exit_code, 5);
    EXPECT_NE(drawn.out.find("drawn             3"), std::string::npos) << drawn.out;
    for (const std::string name : {"a.png", "sea/b.png", "sea/deep/c d&.png"}) {
        // Whole, however many are drawn at a time.
        const std::regex block("(^|\\n)photos/" + name +
                               ": \\d+ x \\d+ pixels, style ink, seed \\d+, \\d+ x \\d+ nodes\\n"
                               "  reading [0-9.]+, .*writing [0-9.]+, thumbnails [0-9.]+, all [0-9.]+ s\\n"
                               "  dendrite \\d+ endpoints, .*drawn \\d+ nodes in \\d+ strokes, .*kept from .*\\n"
                               "out/" +
                               name + ": png, \\d+ x \\d+, \\d+ bytes\\n");
        EXPECT_TRUE(std::regex_search(drawn.err, block)) << name << "\n" << drawn.err;
    }
    EXPECT_EQ(std::count(drawn.err.begin(), drawn.err.end(), '\n'), 3 * 4 + 1) << "the bad one's line is the error's";
    const std::string later = draw_all({"--verbose"}).err;
    for (const char* name : {"a.png", "sea/b.png", "sea/deep/c d&.png"})
        EXPECT_NE(later.find(std::string("photos/") + name + ": up to date\n"), std::string::npos) << later;
    EXPECT_NE(draw({"photos", "new", "--verbose", "--dry-run"}).err.find("photos/a.png: to be drawn\n"),
              std::string::npos);
}

TEST_F(FolderTest, RefusesFoldersThatCannotBeThese) {
    expect_error(draw({"photos", "in.png"}), 2, {"in.png", "is a file"});
    expect_error(draw({"photos", "all.png"}), 2, {"all.png", "names a file"});
    expect_error(draw({"photos", "photos"}), 2, {"photos", "also the input"});
    expect_error(draw({"photos"}), 2, {"photos", "give OUT"});
    expect_error(draw({"photos", "out", "-o", "b.svg"}), 2, {"photos", "--format"});
    expect_error(draw({"photos", "out", "--set", "width.widset=3"}), 2, {"widset"});
    expect_error(draw({"photos", "out", "--mask", "none.png"}), 3, {"none.png"});
    expect_error(draw({"photos", "out", "--include", "*.webp"}), 3, {"photos", "no pictures", "--include"});
    expect_error(draw({"in.png", "out.png", "--include", "*.webp"}), 2, {"in.png", "--include"});
    EXPECT_FALSE(fs::exists(folder_ / "out"));
}

}  // namespace
}  // namespace dstylize::test
