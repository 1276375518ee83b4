#pragma once
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "support/temp_folder.h"

extern char** environ;

namespace dstylize::test {

/// A program that was started in a folder, with its standard streams on files outside of it.
class Process {
  public:
    Process(std::vector<std::string> command, const std::filesystem::path& folder, std::string_view input = "") {
        write_file(streams_ / "in", input);
        posix_spawn_file_actions_t files;
        posix_spawn_file_actions_init(&files);
        posix_spawn_file_actions_addchdir_np(&files, folder.c_str());
        const std::string in = streams_ / "in", out = streams_ / "out", err = streams_ / "err";
        posix_spawn_file_actions_addopen(&files, STDIN_FILENO, in.c_str(), O_RDONLY, 0);
        posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, out.c_str(), O_WRONLY | O_CREAT, 0600);
        posix_spawn_file_actions_addopen(&files, STDERR_FILENO, err.c_str(), O_WRONLY | O_CREAT, 0600);
        std::vector<char*> words;
        for (std::string& word : command) words.push_back(word.data());
        words.push_back(nullptr);
        const int error = posix_spawn(&pid_, words[0], &files, nullptr, words.data(), environ);
        posix_spawn_file_actions_destroy(&files);
        if (error != 0) throw std::runtime_error("cannot start " + command[0]);
    }
    ~Process() {
        if (pid_ > 0) {
            ::kill(pid_, SIGKILL);
            ::waitpid(pid_, nullptr, 0);
        }
    }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    pid_t id() const { return pid_; }
    void send(int signal) const { ::kill(pid_, signal); }
    /// Its exit code, or 1000 + the signal that ended it.
    int wait() {
        int status = 0;
        ::waitpid(pid_, &status, 0);
        pid_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
    }
    std::string out() const { return file_bytes(streams_ / "out"); }
    std::string err() const { return file_bytes(streams_ / "err"); }

  private:
    TempFolder streams_;
    pid_t pid_ = -1;
};

struct Outcome {
    int exit_code = -1;
    std::string out, err;
};

/// Runs dstylize in `folder` to its end.
inline Outcome dstylize(std::vector<std::string> arguments, const std::filesystem::path& folder,
                        std::string_view input = "") {
    arguments.insert(arguments.begin(), DSTYLIZE_PROGRAM);
    Process process(std::move(arguments), folder, input);
    const int exit_code = process.wait();
    return {exit_code, process.out(), process.err()};
}

}  // namespace dstylize::test
