#include "app/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "core/error.h"

namespace dstylize::app {
namespace {

[[noreturn]] void refuse(const std::string& program, const std::string& problem, const std::string& remedy) {
    throw Error(ErrorCode::failed, program, problem, remedy);
}

std::string read_all(int descriptor) {
    std::string out;
    std::array<char, 4096> bytes{};
    while (true) {
        const ssize_t n = ::read(descriptor, bytes.data(), bytes.size());
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return out;
        out.append(bytes.data(), std::size_t(n));
    }
}

}  // namespace

std::string output_of(const std::vector<std::string>& command) {
    std::vector<std::string> copies = command;
    std::vector<char*> words;
    for (std::string& word : copies) words.push_back(word.data());
    words.push_back(nullptr);
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) refuse(command[0], "cannot be started", "close other programs");
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, ends[1], STDOUT_FILENO);
    pid_t child = -1;
    const int error = ::posix_spawnp(&child, words[0], &files, nullptr, words.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    ::close(ends[1]);
    std::string out = error == 0 ? read_all(ends[0]) : "";
    ::close(ends[0]);
    if (error != 0)
        refuse(command[0], std::string("cannot be started (") + std::strerror(error) + ")",
               "check that it is installed");
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) refuse(command[0], "failed", "see what it says above");
    return out;
}

}  // namespace dstylize::app
