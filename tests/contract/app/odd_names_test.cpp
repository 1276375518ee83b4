// Names are only names, and nothing is written outside of the folder of the drawings. (docs/security.md)
#include <filesystem>

#include "contract/app/folder_fixture.h"

namespace dstylize::test {
namespace {

namespace fs = std::filesystem;

class OddNames : public AppTest {
  protected:
    OddNames() { fs::create_directories(folder_ / "photos"); }
};

TEST_F(OddNames, StayInTheFolderOfTheDrawings) {
    const std::set<std::string> names{"a..png",
                                      "-o.png",
                                      "--force.png",
                                      "a;touch hacked;.png",
                                      "$(touch hacked).png",
                                      "`touch hacked`.png",
                                      "a|touch hacked.png",
                                      "a\nb.png",
                                      "%s%n.png",
                                      "\xff\xfe.png",
                                      "*.png",
                                      "~.png",
                                      "\\..\\up.png"};
    for (const std::string& name : names) write_png(folder_ / ("photos/" + name), scene({20, 20}));
    const auto before = folder_.names();
    const Outcome outcome = draw({"photos", "out"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    std::set<std::string> drawn;
    for (const auto& [name, bytes] : results(folder_ / "out")) drawn.insert(name);
    EXPECT_EQ(drawn, names);
    auto after = before;
    after.insert("out");
    EXPECT_EQ(folder_.names(), after);
}

TEST_F(OddNames, ThatAreNoUtf8AreNotDrawnTwiceAndMerged) {
    write_png(folder_ / "photos/caf\xe9.png", scene({20, 20}));
    expect_done(draw({"photos", "out"}));
    const auto drawn_at = fs::last_write_time(folder_ / "out/caf\xe9.png");
    expect_done(draw({"photos", "out"}));
    EXPECT_EQ(fs::last_write_time(folder_ / "out/caf\xe9.png"), drawn_at);
    expect_done(draw({"photos", "out", "--manifest", "list", "--shard", "1/1"}));
    expect_done(run({"merge-reports", "out"}));
    const std::string page = file_bytes(folder_ / "out/index.html");
    EXPECT_NE(page.find("href=\"caf%E9.png\""), std::string::npos) << page;
}

TEST_F(OddNames, NoLinkTakesReportsOrThumbnailsElsewhere) {
    write_png(folder_ / "photos/a.png", scene({20, 20}));
    for (const std::string link :
         {"report.json", "index.html", ".dstylize/ledger.jsonl", ".dstylize/thumbnails/a.before.jpg"}) {
        SCOPED_TRACE(link);
        fs::remove_all(folder_ / "out");
        write_file(folder_ / "precious", "precious");
        fs::create_directories((folder_ / ("out/" + link)).parent_path());
        fs::create_symlink(folder_ / "precious", folder_ / ("out/" + link));
        const Outcome outcome = draw({"photos", "out"});
        EXPECT_TRUE(outcome.exit_code == 4 || outcome.exit_code == 5) << outcome.exit_code;
        EXPECT_NE(outcome.err.find("a link leads out"), std::string::npos) << outcome.err;
        EXPECT_EQ(file_bytes(folder_ / "precious"), "precious");
    }
    for (const std::string link : {".dstylize", ".dstylize/thumbnails"}) {
        SCOPED_TRACE(link);
        fs::remove_all(folder_ / "out");
        fs::create_directories((folder_ / ("out/" + link)).parent_path());
        fs::create_directories(folder_ / "elsewhere");
        fs::create_directory_symlink(folder_ / "elsewhere", folder_ / ("out/" + link));
        const Outcome outcome = draw({"photos", "out"});
        EXPECT_TRUE(outcome.exit_code == 4 || outcome.exit_code == 5) << outcome.exit_code;
        EXPECT_TRUE(fs::is_empty(folder_ / "elsewhere"));
    }
}

}  // namespace
}  // namespace dstylize::test
