// A folder that is watched: what comes into it is drawn, whole, until an interrupt.
#include <signal.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <thread>

#include "contract/app/folder_fixture.h"

namespace dstylize::test {
namespace {

namespace fs = std::filesystem;

class WatchTest : public FolderTest {
  protected:
    /// Waits for what must come some time.
    static bool comes(const std::function<bool()>& what) {
        for (int n = 0; n < 2000 && !what(); ++n) std::this_thread::sleep_for(std::chrono::milliseconds(50));
        return what();
    }
    bool is_drawn(const std::string& name) const { return fs::exists(folder_ / "out" / name); }
    bool is_reported(const std::string& picture, const std::string& state) const {
        return fs::exists(folder_ / "out/report.json") && states().contains(picture) && states()[picture] == state;
    }
};

TEST_F(WatchTest, DrawsWhatIsThereAndWhatComesUntilInterrupted) {
    Process watch({DSTYLIZE_PROGRAM, "photos", "out", "--watch", "--style", "ink", "--detail", "64"}, folder_.path());
    EXPECT_TRUE(comes([&] { return is_reported("sea/deep/c d&.png", "done"); }));

    write_png(folder_ / "photos/new.png", scene({50, 40}));
    EXPECT_TRUE(comes([&] { return is_reported("new.png", "done"); }));
    EXPECT_EQ(states().size(), 4u) << "the report is of all";

    // Half a picture that its writer does not go on with is named; it is drawn when it is whole.
    write_png(folder_ / "whole.png", scene({60, 44}));
    const std::string whole = file_bytes(folder_ / "whole.png");
    write_file(folder_ / "photos/slow.png", std::string_view(whole).substr(0, whole.size() / 2));
    EXPECT_TRUE(comes([&] { return is_reported("slow.png", "failed"); }));
    EXPECT_FALSE(is_drawn("slow.png"));
    std::ofstream(folder_ / "photos/slow.png", std::ios::binary | std::ios::app) << whole.substr(whole.size() / 2);
    EXPECT_TRUE(comes([&] { return is_reported("slow.png", "done"); }));

    watch.send(SIGINT);
    EXPECT_EQ(watch.wait(), 130) << watch.err();
    const auto watched = results(folder_ / "out");
    EXPECT_EQ(watched.size(), 5u);
    expect_done(draw({"photos", "whole"}));
    EXPECT_TRUE(watched == results(folder_ / "whole")) << "the bytes of a run that is not watched";
    expect_done(draw_all());
    for (const auto& [picture, state] : states()) EXPECT_EQ(state, "up to date") << picture;
}

TEST_F(WatchTest, BeginsWithAnEmptyFolderButNotWithAWrongCommand) {
    fs::create_directory(folder_ / "empty");
    Process watch({DSTYLIZE_PROGRAM, "empty", "out", "--watch", "--style", "ink", "--detail", "64"}, folder_.path());
    EXPECT_TRUE(comes([&] { return watch.out().find("watching empty") != std::string::npos; }));
    fs::copy(folder_ / "in.png", folder_ / "empty/x.png");
    EXPECT_TRUE(comes([&] { return is_reported("x.png", "done"); }));
    watch.send(SIGTERM);
    EXPECT_EQ(watch.wait(), 130) << watch.err();

    expect_error(draw({"empty", "out", "--watch", "--mask", "none.png"}), 3, {"none.png"});
    expect_error(draw({"empty", "out", "--watch", "--dry-run"}), 2, {"--dry-run", "--watch"});
    expect_error(draw({"empty", "out", "--watch", "--manifest", "m"}), 2, {"--manifest", "--watch"});
    expect_error(draw({"in.png", "out.png", "--watch"}), 2, {"in.png", "--watch"});
}

}  // namespace
}  // namespace dstylize::test
