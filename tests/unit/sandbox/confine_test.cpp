// The decoder is confined: what it has no business with is refused to a program that is confined like it, and the
// decoder itself is confined so.
#include <gtest/gtest.h>

#include <cerrno>
#include <fstream>
#include <string>
#include <tuple>
#include <vector>

#include "core/error.h"
#include "support/picture_files.h"
#include "support/process.h"
#include "support/scenes.h"

namespace dstylize::test {
namespace {

constexpr int kUnconfined = 250;

class Probe : public ::testing::TestWithParam<std::tuple<const char*, int>> {
  protected:
    Probe() { write_file(folder_ / "old", "old"); }
    int tried(std::vector<std::string> words) const {
        words.insert(words.begin(), DSTYLIZE_PROBE);
        return Process(words, folder_.path()).wait();
    }
    TempFolder folder_;
};

TEST_P(Probe, IsHeldToWhatDecodingNeeds) {
    const auto [attempt, error] = GetParam();
    const int confined = tried({attempt});
    if (confined == kUnconfined) GTEST_SKIP() << "this kernel confines nothing";
    EXPECT_EQ(confined, error);
    EXPECT_EQ(folder_.names(), (std::set<std::string>{"old"}));
    EXPECT_EQ(file_bytes(folder_ / "old"), "old");
    EXPECT_EQ(tried({attempt, "free"}), 0) << "the attempt itself is wrong";
}

INSTANTIATE_TEST_SUITE_P(Refused, Probe,
                         ::testing::Values(std::tuple{"internet_socket", EPERM}, std::tuple{"datagram_socket", EPERM},
                                           std::tuple{"local_socket", EPERM}, std::tuple{"create_file", EPERM},
                                           std::tuple{"create_to_read", EPERM}, std::tuple{"nameless_file", EPERM},
                                           std::tuple{"write_file", EPERM}, std::tuple{"empty_file", EPERM},
                                           std::tuple{"read_file", EACCES}, std::tuple{"list_folder", EACCES},
                                           std::tuple{"make_folder", EPERM}, std::tuple{"remove_file", EPERM},
                                           std::tuple{"rename_file", EPERM}, std::tuple{"link_file", EPERM},
                                           std::tuple{"symbolic_link", EPERM}, std::tuple{"process", EPERM},
                                           std::tuple{"program", EPERM}, std::tuple{"shell", EPERM},
                                           std::tuple{"signal_parent", EPERM}, std::tuple{"signal_by_pipe", EPERM},
                                           std::tuple{"signal_of_choice", EPERM}, std::tuple{"limit", EPERM},
                                           std::tuple{"code", EPERM}, std::tuple{"much_memory", ENOMEM},
                                           std::tuple{"much_shared_memory", EFBIG}),
                         [](const auto& row) { return std::string(std::get<0>(row.param)); });

INSTANTIATE_TEST_SUITE_P(Granted, Probe,
                         ::testing::Values(std::tuple{"some_memory", 0}, std::tuple{"some_shared_memory", 0},
                                           std::tuple{"own_memory", 0}, std::tuple{"thread", 0}, std::tuple{"pipe", 0}),
                         [](const auto& row) { return std::string(std::get<0>(row.param)); });

std::vector<pid_t> children_of(pid_t parent) {
    std::ifstream list("/proc/" + std::to_string(parent) + "/task/" + std::to_string(parent) + "/children");
    std::vector<pid_t> children;
    for (pid_t child; list >> child;) children.push_back(child);
    return children;
}

/// The rest of the line of /proc/PID/FILE that begins with `key`.
std::string line_of(pid_t process, const std::string& file, const std::string& key) {
    std::ifstream lines("/proc/" + std::to_string(process) + "/" + file);
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with(key)) return line.substr(line.find_first_not_of(" \t", key.size()));
    return "";
}

/// Whether this kernel can confine; that the codec asks it to is what is tested.
bool kernel_confines() {
    const TempFolder folder;
    return Process({DSTYLIZE_PROBE, "thread"}, folder.path()).wait() != kUnconfined;
}

/// The process that decodes: the child of our only child.
pid_t worker() {
    const auto codecs = children_of(getpid());
    const auto workers = codecs.size() == 1 ? children_of(codecs[0]) : std::vector<pid_t>{};
    return workers.size() == 1 ? workers[0] : 0;
}

TEST(CodecConfinement, HoldsForTheProcessThatDecodes) {
    PictureCodec own({DSTYLIZE_CODEC, 1ull << 30, 120, false});
    const auto png = own.encode(scene({40, 30}), {}, "a.png");
    const DecodedPicture decoded = own.decode(png, "a.png");
    EXPECT_EQ(line_of(worker(), "limits", "Max core file size").substr(0, 1), "0");
    EXPECT_EQ(line_of(worker(), "limits", "Max open files").substr(0, 2), "64");
    if (!kernel_confines()) GTEST_SKIP() << "this kernel confines nothing";
    EXPECT_TRUE(decoded.confinement.system_calls && decoded.confinement.files);
    EXPECT_EQ(line_of(worker(), "status", "Seccomp:"), "2");
    EXPECT_EQ(line_of(worker(), "status", "NoNewPrivs:"), "1");
}

TEST(CodecConfinement, HoldsForTheNextOneAfterDamage) {
    PictureCodec own({DSTYLIZE_CODEC, 1ull << 30, 120, false});
    auto png = own.encode(scene({40, 30}), {}, "a.png");
    const pid_t first = worker();
    png.resize(png.size() / 2);
    EXPECT_THROW(own.decode(png, "a.png"), Error);
    const auto whole = own.encode(scene({40, 30}), {}, "a.png");
    const pid_t second = worker();
    EXPECT_NE(first, second);
    if (!kernel_confines()) GTEST_SKIP() << "this kernel confines nothing";
    EXPECT_TRUE(own.decode(whole, "a.png").confinement.system_calls);
    EXPECT_EQ(line_of(second, "status", "Seccomp:"), "2");
}

}  // namespace
}  // namespace dstylize::test
