#include <dirent.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "ipc/codec_protocol.h"
#include "unit/formats/codec_fixture.h"

namespace dstylize::test {
namespace {

using namespace std::string_literals;

std::vector<pid_t> children_of(pid_t parent) {
    std::vector<pid_t> children;
    std::error_code ignored;
    const std::string tasks = "/proc/" + std::to_string(parent) + "/task";
    for (const auto& task : std::filesystem::directory_iterator(tasks, ignored)) {
        std::ifstream list(task.path() / "children");
        for (pid_t child; list >> child;) children.push_back(child);
    }
    return children;
}

/// Processor time used so far, in clock ticks.
long ticks_used(pid_t pid) {
    std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
    std::string text((std::istreambuf_iterator<char>(stat)), {});
    std::istringstream fields(text.substr(std::min(text.size(), text.rfind(')') + 1)));
    std::string field;
    long user = 0, system = 0;
    for (int n = 0; n < 11; ++n) fields >> field;
    fields >> user >> system;
    return user + system;
}

/// Whether any thread of the process still runs.
bool runs(pid_t pid) {
    std::error_code ignored;
    const std::filesystem::directory_iterator tasks("/proc/" + std::to_string(pid) + "/task", ignored);
    if (std::distance(begin(tasks), end(tasks)) > 1) return true;
    std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
    std::string number, name, state;
    return (stat >> number >> name >> state) && state != "Z" && state != "X";
}

std::size_t open_files() {
    std::size_t count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) ++count;
    return count;
}

const FileBytes& small_picture() {
    static const FileBytes file = png_file({1, 1, 8, 0}, "\7"s);
    return file;
}

/// A picture that takes the codec a while: 8 megapixels in decimal digits.
FileBytes slow_picture() {
    constexpr std::size_t kSamples = 8'000'000;
    std::string text = "P2\n4000 2000\n255\n";
    text.reserve(text.size() + kSamples * 3);
    for (std::size_t n = 0; n < kSamples; ++n) text += "99 ";
    return file_of(text);
}

/// A program in place of the codec, told by a shell script.
class FakeCodec {
  public:
    explicit FakeCodec(const std::string& script) {
        char name[] = "/tmp/fake-codec-XXXXXX";
        const int file = mkstemp(name);
        path_ = name;
        const std::string text = "#!/bin/sh\n" + script + "\n";
        EXPECT_EQ(write(file, text.data(), text.size()), ssize_t(text.size()));
        fchmod(file, 0700);
        close(file);
    }
    ~FakeCodec() { std::filesystem::remove(path_); }
    CodecOptions options() const {
        CodecOptions options;
        options.program = path_;
        return options;
    }

  private:
    std::string path_;
};

constexpr const char* kGreeting = "printf '\\002\\000\\000\\000' >&3";

TEST(CodecProcess, AMissingProgramIsNamed) {
    CodecOptions options;
    options.program = "/nowhere/dstylize-codec";
    const Error error = error_of([&] { PictureCodec codec(options); });
    EXPECT_EQ(error.code(), ErrorCode::failed);
    EXPECT_EQ(error.file(), "/nowhere/dstylize-codec");
    EXPECT_FALSE(error.remedy().empty());
}

TEST(CodecProcess, AProgramThatEndsAtOnceIsNoPicturesFault) {
    const FakeCodec fake("exit 3");
    PictureCodec codec(fake.options());
    const Error error = error_of([&] { codec.decode(small_picture(), "picture"); });
    EXPECT_EQ(error.code(), ErrorCode::failed);
    EXPECT_NE(error.problem().find("exit status 3"), std::string::npos);
}

TEST(CodecProcess, AnotherVersionIsRefused) {
    const FakeCodec fake("printf '\\377\\000\\000\\000' >&3; sleep 100");
    PictureCodec codec(fake.options());
    EXPECT_NE(error_of([&] { codec.decode(small_picture(), "p"); }).problem().find("version"), std::string::npos);
}

TEST(CodecProcess, AStuckDecoderIsEndedAfterTheTimeout) {
    const FakeCodec fake(kGreeting + "; exec sleep 100"s);
    CodecOptions options = fake.options();
    options.timeout_s = 0.2;
    PictureCodec codec(options);
    const Error error = error_of([&] { codec.decode(small_picture(), "picture"); });
    EXPECT_EQ(error.code(), ErrorCode::cannot_read);
    EXPECT_EQ(error.file(), "picture");
    EXPECT_NE(error.problem().find("took longer than 0.2 s"), std::string::npos);
}

TEST(CodecProcess, NoAnswerIsBelievedUnchecked) {
    // Too short, too long, and of the right length but without what it promises.
    const std::string right = "head -c " + std::to_string(sizeof(ipc::CodecAnswer)) + " /dev/zero >&3";
    for (const std::string& answer : {"printf done >&3"s, "head -c 100000 /dev/zero >&3"s, right}) {
        const FakeCodec fake(kGreeting + "; dd bs=4096 count=1 <&3 >/dev/null 2>&1; "s + answer + "; sleep 100");
        PictureCodec codec(fake.options());
        const Error error = error_of([&] { codec.decode(small_picture(), "picture"); });
        EXPECT_EQ(error.code(), ErrorCode::cannot_read) << answer;
    }
}

TEST(CodecProcess, KilledWhileIdleItIsRenewed) {
    PictureCodec codec(codec_options());
    codec.decode(small_picture(), "picture");
    const std::vector<pid_t> before = children_of(getpid());
    ASSERT_EQ(before.size(), 1u);
    const std::vector<pid_t> workers = children_of(before[0]);
    ASSERT_EQ(workers.size(), 1u);
    kill(before[0], SIGKILL);
    while (runs(before[0]) || runs(workers[0])) std::this_thread::yield();
    EXPECT_EQ(codec.decode(small_picture(), "picture").picture[0], (Rgba8{7, 7, 7}));
    EXPECT_NE(children_of(getpid()), before);
}

TEST(CodecProcess, AWorkerKilledInTheMiddleCostsOnlyItsPicture) {
    const FileBytes slow = slow_picture();
    PictureCodec codec(codec_options());
    codec.decode(small_picture(), "picture");
    const std::vector<pid_t> codecs = children_of(getpid());
    ASSERT_EQ(codecs.size(), 1u);
    const std::vector<pid_t> workers = children_of(codecs[0]);
    ASSERT_EQ(workers.size(), 1u);
    const long idle = ticks_used(workers[0]);
    std::thread killer([&] {
        while (ticks_used(workers[0]) < idle + 5) std::this_thread::yield();
        kill(workers[0], SIGKILL);
    });
    const Error error = error_of([&] { codec.decode(slow, "slow"); });
    killer.join();
    EXPECT_EQ(error.code(), ErrorCode::cannot_read);
    EXPECT_EQ(error.file(), "slow");
    EXPECT_NE(error.problem().find("signal 9"), std::string::npos) << error.what();
    EXPECT_EQ(codec.decode(small_picture(), "picture").picture[0], (Rgba8{7, 7, 7}));
    EXPECT_EQ(children_of(getpid()), codecs);  // the same program, a new worker
}

TEST(CodecProcess, NothingIsLeftBehind) {
    const std::size_t files = open_files();
    {
        PictureCodec codec(codec_options());
        for (int n = 0; n < 3; ++n) {
            codec.decode(small_picture(), "picture");
            error_of([&] { codec.decode(file_of("\x89PNG\r\n\x1a\n"), "broken"); });
            codec.encode(Picture({2, 2}), {}, "out");
        }
    }
    { PictureCodec unused(codec_options()); }
    EXPECT_EQ(open_files(), files);
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
    EXPECT_EQ(errno, ECHILD);
}

TEST(CodecProcess, ItEndsWithItsParent) {
    int numbers[2];
    ASSERT_EQ(pipe(numbers), 0);
    const pid_t parent = fork();
    if (parent == 0) {
        PictureCodec codec(codec_options());
        codec.decode(small_picture(), "picture");
        const std::vector<pid_t> codecs = children_of(getpid());
        const std::vector<pid_t> workers = children_of(codecs.at(0));
        const pid_t pids[2] = {codecs.at(0), workers.at(0)};
        if (write(numbers[1], pids, sizeof(pids)) != sizeof(pids)) _exit(1);
        kill(getpid(), SIGKILL);
    }
    close(numbers[1]);
    pid_t pids[2];
    ASSERT_EQ(read(numbers[0], pids, sizeof(pids)), ssize_t(sizeof(pids)));
    close(numbers[0]);
    waitpid(parent, nullptr, 0);
    for (int n = 0; n < 500 && (runs(pids[0]) || runs(pids[1])); ++n) usleep(10'000);
    EXPECT_FALSE(runs(pids[0]));
    EXPECT_FALSE(runs(pids[1]));
}

TEST(CodecProcess, SeveralWorkSideBySide) {
    std::vector<std::thread> threads;
    std::atomic<int> good = 0;
    for (int t = 0; t < 3; ++t)
        threads.emplace_back([&] {
            PictureCodec codec(codec_options());
            for (int n = 0; n < 5; ++n) good += codec.decode(small_picture(), "picture").picture[0] == Rgba8{7, 7, 7};
        });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(good, 15);
}

TEST(CodecProcess, AThreadThatStartedItMayEnd) {
    std::unique_ptr<PictureCodec> codec;
    std::thread([&] { codec = std::make_unique<PictureCodec>(codec_options()); }).join();
    for (int n = 0; n < 2; ++n) EXPECT_EQ(codec->decode(small_picture(), "picture").picture[0], (Rgba8{7, 7, 7}));
}

}  // namespace
}  // namespace dstylize::test
