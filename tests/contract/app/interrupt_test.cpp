// Ctrl-C and SIGTERM: exit code 130, no partial file, the old file as it was.
#include <signal.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "contract/app/folder_fixture.h"

namespace dstylize::test {
namespace {

/// Whether the process has come so far that it answers signals itself.
bool watches_signals(pid_t id) {
    std::ifstream status("/proc/" + std::to_string(id) + "/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("SigBlk:")) return std::stoull(line.substr(7), nullptr, 16) >> (SIGINT - 1) & 1;
    return false;
}

void wait_until_it_watches(const Process& process) {
    for (int n = 0; n < 3000 && !watches_signals(process.id()); ++n)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

class InterruptTest : public AppTest, public ::testing::WithParamInterface<int> {};

TEST_P(InterruptTest, EndsWith130AndLeavesTheOldFile) {
    expect_done(draw({"in.png", "out.png"}));
    const auto before = folder_.names();
    const std::string old = file_bytes(folder_ / "out.png");
    // Far more work than the moments that we wait.
    Process process({DSTYLIZE_PROGRAM, "in.png", "out.png", "--detail", "4000", "--seed", "9"}, folder_.path());
    wait_until_it_watches(process);
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    process.send(GetParam());
    EXPECT_EQ(process.wait(), 130) << process.err();
    EXPECT_EQ(folder_.names(), before);
    EXPECT_EQ(file_bytes(folder_ / "out.png"), old);
}

/// A folder with so many pictures that a run is interrupted among them.
class InterruptFolderTest : public FolderTest {
  protected:
    static constexpr std::size_t kPictures = 44;

    InterruptFolderTest() {
        for (int k = 100; k < 140; ++k) write_png(folder_ / "photos" / (std::to_string(k) + ".png"), scene({70, 60}));
        write_file(folder_ / "photos/0.png", std::string_view("no PNG"));
    }
    /// Interrupts a run as soon as it has made a result. Says what it said.
    Outcome interrupted(Words more = {}) const {
        Words command{DSTYLIZE_PROGRAM, "photos", "out", "--style", "ink", "--detail", "64", "--threads", "1"};
        command.insert(command.end(), more.begin(), more.end());
        Process process(command, folder_.path());
        wait_until_it_watches(process);
        for (int n = 0; n < 3000 && results(folder_ / "out").empty(); ++n)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        process.send(SIGINT);
        const int code = process.wait();
        return {code, process.out(), process.err()};
    }
    bool is_reported() const { return std::filesystem::exists(folder_ / "out/report.json"); }
};

TEST_F(InterruptFolderTest, LeavesAReportOfWhatWasDone) {
    // One that does not heed it within a second, on a machine that does other things, is ended without a report.
    Outcome outcome;
    for (int tries = 0; tries < 5 && !is_reported(); ++tries) {
        std::filesystem::remove_all(folder_ / "out");
        outcome = interrupted();
        EXPECT_EQ(outcome.exit_code, 130) << outcome.err;
    }
    ASSERT_TRUE(is_reported());
    EXPECT_TRUE(outcome.err.ends_with("dstylize: interrupted\n")) << outcome.err;
    std::map<std::string, std::size_t> count;
    for (const auto& [picture, state] : states()) {
        ++count[state];
        EXPECT_EQ(std::filesystem::exists(folder_ / "out" / picture), state == "done") << picture << " " << state;
    }
    EXPECT_EQ(states()["0.png"], "failed");
    EXPECT_GE(count["done"], 1u);
    EXPECT_GE(count["not reached"], 1u);
    EXPECT_EQ(count["done"] + count["failed"] + count["not reached"], kPictures);
    EXPECT_NE(outcome.out.find("\nnot reached "), std::string::npos) << outcome.out;
    const std::string page = file_bytes(folder_ / "out/index.html");
    EXPECT_NE(page.find(std::to_string(count["not reached"]) + " not reached"), std::string::npos);
    const std::string figure = "<figure";
    std::size_t figures = 0;
    for (std::size_t at = 0; (at = page.find(figure, at)) != std::string::npos; at += figure.size()) ++figures;
    EXPECT_EQ(figures, count["done"] + count["failed"]);
    for (const std::string& name : names_in(folder_ / "out")) EXPECT_FALSE(name.ends_with(".tmp")) << name;

    EXPECT_EQ(draw_all().exit_code, 5);
    EXPECT_EQ(draw({"photos", "whole"}).exit_code, 5);
    EXPECT_TRUE(results(folder_ / "out") == results(folder_ / "whole")) << "the next run goes on";
    for (const auto& [picture, state] : states()) EXPECT_NE(state, "not reached") << picture;
}

TEST_F(InterruptFolderTest, LeavesNoReportOfAShardWhichMustBeRunAgain) {
    EXPECT_EQ(interrupted({"--manifest", "list", "--shard", "1/1"}).exit_code, 130);
    expect_error(run({"merge-reports", "out"}), 3, {"no report of shard 1", "run it again"});
}

INSTANTIATE_TEST_SUITE_P(Signals, InterruptTest, ::testing::Values(SIGINT, SIGTERM),
                         [](const auto& row) { return row.param == SIGINT ? "sigint" : "sigterm"; });

}  // namespace
}  // namespace dstylize::test
