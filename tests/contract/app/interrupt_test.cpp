// Ctrl-C and SIGTERM: exit code 130, no partial file, the old file as it was.
#include <signal.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "contract/app/app_fixture.h"

namespace dstylize::test {
namespace {

/// Whether the process has come so far that it answers signals itself.
bool watches_signals(pid_t id) {
    std::ifstream status("/proc/" + std::to_string(id) + "/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("SigBlk:")) return std::stoull(line.substr(7), nullptr, 16) >> (SIGINT - 1) & 1;
    return false;
}

class InterruptTest : public AppTest, public ::testing::WithParamInterface<int> {};

TEST_P(InterruptTest, EndsWith130AndLeavesTheOldFile) {
    expect_done(draw({"in.png", "out.png"}));
    const auto before = folder_.names();
    const std::string old = file_bytes(folder_ / "out.png");
    // Far more work than the moments that we wait.
    Process process({DSTYLIZE_PROGRAM, "in.png", "out.png", "--detail", "4000", "--seed", "9"}, folder_.path());
    for (int n = 0; n < 3000 && !watches_signals(process.id()); ++n)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    process.send(GetParam());
    EXPECT_EQ(process.wait(), 130) << process.err();
    EXPECT_EQ(folder_.names(), before);
    EXPECT_EQ(file_bytes(folder_ / "out.png"), old);
}

INSTANTIATE_TEST_SUITE_P(Signals, InterruptTest, ::testing::Values(SIGINT, SIGTERM),
                         [](const auto& row) { return row.param == SIGINT ? "sigint" : "sigterm"; });

}  // namespace
}  // namespace dstylize::test
