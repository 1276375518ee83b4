#include "formats/files.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>

#include "core/error.h"

namespace dstylize {
namespace {

namespace fs = std::filesystem;

std::vector<std::byte> bytes(const std::string& text) {
    const auto* begin = reinterpret_cast<const std::byte*>(text.data());
    return {begin, begin + text.size()};
}

std::string content(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

class Files : public testing::Test {
  protected:
    Files() {
        char name[] = "/tmp/files-test-XXXXXX";
        folder_ = mkdtemp(name);
    }
    ~Files() override {
        fs::permissions(folder_, fs::perms::owner_all);
        fs::remove_all(folder_);
    }
    fs::path path(const std::string& name) const { return folder_ / name; }
    /// Names in the folder, hidden ones too.
    std::size_t entries() const {
        return std::size_t(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
    }
    template <class Act>
    static Error error_of(Act act) {
        try {
            act();
        } catch (const Error& error) {
            return error;
        }
        ADD_FAILURE() << "no error";
        return Error(ErrorCode::failed, "", "", "");
    }

  private:
    fs::path folder_;
};

TEST_F(Files, WrittenIsRead) {
    const std::string text("a\0b\n", 4);
    write_file_atomically(path("new"), bytes(text));
    EXPECT_EQ(content(path("new")), text);
    EXPECT_EQ(read_file(path("new"), 100), bytes(text));
    write_file_atomically(path("empty"), {});
    EXPECT_TRUE(read_file(path("empty"), 0).empty());
    EXPECT_EQ(entries(), 2u);
}

TEST_F(Files, AnExistingFileIsReplacedWithItsMode) {
    write_file_atomically(path("f"), bytes("old and longer"));
    fs::permissions(path("f"), fs::perms(0640));
    write_file_atomically(path("f"), bytes("new"));
    EXPECT_EQ(content(path("f")), "new");
    EXPECT_EQ(fs::status(path("f")).permissions(), fs::perms(0640));
    EXPECT_EQ(entries(), 1u);
}

TEST_F(Files, NewFilesObeyTheUmask) {
    const mode_t before = umask(027);
    write_file_atomically(path("f"), bytes("x"));
    umask(before);
    EXPECT_EQ(fs::status(path("f")).permissions(), fs::perms(0640));
}

TEST_F(Files, ASymbolicLinkStaysOne) {
    write_file_atomically(path("target"), bytes("old"));
    fs::create_symlink("target", path("link"));
    write_file_atomically(path("link"), bytes("new"));
    EXPECT_TRUE(fs::is_symlink(path("link")));
    EXPECT_EQ(content(path("target")), "new");
    EXPECT_EQ(entries(), 2u);
}

TEST_F(Files, LongNamesWork) {
    const std::string name(255, 'n');
    write_file_atomically(path(name), bytes("1"));
    write_file_atomically(path(name), bytes("2"));
    EXPECT_EQ(content(path(name)), "2");
    EXPECT_EQ(error_of([&] { write_file_atomically(path(name + "n"), bytes("3")); }).code(), ErrorCode::cannot_write);
}

TEST_F(Files, AFailedWriteKeepsTheOldFileAndLeavesNothing) {
    write_file_atomically(path("f"), bytes("old"));
    // A limit on the size of files fails the write as a full disk does.
    rlimit limit;
    getrlimit(RLIMIT_FSIZE, &limit);
    const rlimit small{1000, limit.rlim_max};
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &small);
    const Error existing = error_of([&] { write_file_atomically(path("f"), bytes(std::string(5000, 'x'))); });
    const Error fresh = error_of([&] { write_file_atomically(path("g"), bytes(std::string(5000, 'x'))); });
    setrlimit(RLIMIT_FSIZE, &limit);
    std::signal(SIGXFSZ, handler);
    EXPECT_EQ(existing.code(), ErrorCode::cannot_write);
    EXPECT_EQ(existing.file(), path("f").string());
    EXPECT_FALSE(existing.remedy().empty());
    EXPECT_EQ(fresh.code(), ErrorCode::cannot_write);
    EXPECT_EQ(content(path("f")), "old");
    EXPECT_EQ(entries(), 1u);
}

TEST_F(Files, UnusableTargetsAreRefused) {
    fs::create_directory(path("folder"));
    EXPECT_EQ(error_of([&] { write_file_atomically(path("folder"), bytes("x")); }).code(), ErrorCode::cannot_write);
    EXPECT_EQ(error_of([&] { write_file_atomically(path("none/f"), bytes("x")); }).code(), ErrorCode::cannot_write);
    write_file_atomically(path("f"), bytes("x"));
    EXPECT_EQ(error_of([&] { write_file_atomically(path("f/g"), bytes("x")); }).code(), ErrorCode::cannot_write);
    EXPECT_EQ(entries(), 2u);
}

TEST_F(Files, ProtectedFilesAndFoldersAreLeftAlone) {
    if (geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
    write_file_atomically(path("f"), bytes("old"));
    fs::permissions(path("f"), fs::perms::owner_read);
    EXPECT_EQ(error_of([&] { write_file_atomically(path("f"), bytes("new")); }).code(), ErrorCode::cannot_write);
    EXPECT_EQ(content(path("f")), "old");
    fs::permissions(path("."), fs::perms::owner_read | fs::perms::owner_exec);
    EXPECT_EQ(error_of([&] { write_file_atomically(path("g"), bytes("new")); }).code(), ErrorCode::cannot_write);
}

TEST_F(Files, AtEveryMomentTheFileIsOldOrNew) {
    const std::string old(200'000, 'o'), fresh(300'000, 'n');
    write_file_atomically(path("f"), bytes(old));
    std::thread writer([&] {
        for (int n = 0; n < 40; ++n) write_file_atomically(path("f"), bytes(n % 2 ? old : fresh));
    });
    for (int n = 0; n < 200; ++n) {
        const std::string seen = content(path("f"));
        EXPECT_TRUE(seen == old || seen == fresh) << seen.size();
    }
    writer.join();
    EXPECT_EQ(entries(), 1u);
}

TEST_F(Files, AKilledWriterLeavesOldOrNew) {
    write_file_atomically(path("f"), bytes(std::string(1000, 'o')));
    for (int n = 0; n < 20; ++n) {
        const pid_t child = fork();
        if (child == 0) {
            while (true) write_file_atomically(path("f"), bytes(std::string(2'000'000, 'n')));
        }
        usleep(useconds_t(1000 * n));
        kill(child, SIGKILL);
        waitpid(child, nullptr, 0);
        const std::string seen = content(path("f"));
        EXPECT_TRUE(seen == std::string(1000, 'o') || seen == std::string(2'000'000, 'n')) << seen.size();
    }
}

TEST_F(Files, MissingFoldersAndLongFilesAreNotRead) {
    const Error missing = error_of([&] { read_file(path("none"), 100); });
    EXPECT_EQ(missing.code(), ErrorCode::cannot_read);
    EXPECT_EQ(missing.problem(), "no such file");
    EXPECT_EQ(error_of([&] { read_file(path("."), 100); }).problem(), "is a folder");
    write_file_atomically(path("f"), bytes(std::string(101, 'x')));
    EXPECT_EQ(error_of([&] { read_file(path("f"), 100); }).code(), ErrorCode::cannot_read);
    EXPECT_EQ(read_file(path("f"), 101).size(), 101u);
}

TEST_F(Files, PipesAreReadAndWritten) {
    ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
    const std::string text(1'000'000, 'p');
    std::thread writer([&] { write_file_atomically(path("pipe"), bytes(text)); });
    EXPECT_EQ(read_file(path("pipe"), 2'000'000), bytes(text));
    writer.join();
    Error cut_off(ErrorCode::failed, "", "", "");
    std::thread longer([&] { cut_off = error_of([&] { write_file_atomically(path("pipe"), bytes(text)); }); });
    EXPECT_EQ(error_of([&] { read_file(path("pipe"), 1000); }).code(), ErrorCode::cannot_read);
    longer.join();
    EXPECT_EQ(cut_off.code(), ErrorCode::cannot_write);
}

TEST_F(Files, AReaderThatGoesAwayIsAnErrorNotASignal) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    close(ends[0]);
    const int standard_output = dup(STDOUT_FILENO);
    fflush(stdout);
    dup2(ends[1], STDOUT_FILENO);
    const Error error = error_of([&] { write_file_atomically("-", bytes("text")); });
    dup2(standard_output, STDOUT_FILENO);
    close(standard_output);
    close(ends[1]);
    EXPECT_EQ(error.code(), ErrorCode::cannot_write);
    EXPECT_EQ(error.file(), "standard output");
}

}  // namespace
}  // namespace dstylize
