// confined_probe ATTEMPT [free]: tries one thing that a decoder has no business with, confined as the decoder is, or
// free. Its exit code is 0 when that worked, else the errno; 250 where the kernel confines nothing.
// confined_probe --old-kernel PROGRAM [WORD...] runs a program as on a kernel that knows neither seccomp nor Landlock.
#include <dirent.h>
#include <fcntl.h>
#include <linux/seccomp.h>
#include <seccomp.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <functional>
#include <map>
#include <string>
#include <thread>

#include "sandbox/confine.h"

namespace {

constexpr std::uint64_t kLimit_bytes = 64u << 20;

/// 0 or the errno of a system call that gave `result`.
int error_of(long result) { return result < 0 ? errno : 0; }

int memory_of(std::uint64_t bytes) {
    void* at = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    return at == MAP_FAILED ? errno : 0;
}

int shared_memory_of(std::uint64_t bytes) {
    const int memory = memfd_create("probe", 0);
    return memory < 0 ? errno : error_of(ftruncate(memory, off_t(bytes)));
}

int forked() {
    const pid_t child = fork();
    if (child == 0) _exit(0);
    return child < 0 ? errno : error_of(waitpid(child, nullptr, 0));
}

int executed() {
    char name[] = "true";
    char* arguments[] = {name, nullptr};
    execve("/bin/true", arguments, nullptr);  // exit code 0 when it works
    return errno;
}

int limit_raised() {
    rlimit space{};
    getrlimit(RLIMIT_AS, &space);
    return error_of(setrlimit(RLIMIT_AS, &space));
}

int code_made() {
    void* at = mmap(nullptr, 4096, PROT_READ | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    return at == MAP_FAILED ? errno : 0;
}

int opened_again() {
    const int memory = memfd_create("probe", 0);
    return error_of(open(("/proc/self/fd/" + std::to_string(memory)).c_str(), O_RDONLY));
}

/// A pipe that would send its owner a signal when something can be read.
int pipe_owned_by_parent() {
    int ends[2];
    return pipe(ends) < 0 ? errno : error_of(fcntl(ends[0], F_SETOWN, getppid()));
}

int pipe_with_a_signal() {
    int ends[2];
    return pipe(ends) < 0 ? errno : error_of(fcntl(ends[0], F_SETSIG, SIGCONT));
}

int thread_started() {
    bool ran = false;
    std::thread([&] { ran = true; }).join();
    return ran ? 0 : EAGAIN;
}

/// In the working folder, which has a file `old`.
const std::map<std::string, std::function<int()>> kAttempts{
    {"internet_socket", [] { return error_of(socket(AF_INET, SOCK_STREAM, 0)); }},
    {"datagram_socket", [] { return error_of(socket(AF_INET, SOCK_DGRAM, 0)); }},
    {"local_socket", [] { return error_of(socket(AF_UNIX, SOCK_STREAM, 0)); }},
    {"create_file", [] { return error_of(open("new", O_WRONLY | O_CREAT, 0600)); }},
    {"create_to_read", [] { return error_of(open("new", O_RDONLY | O_CREAT, 0600)); }},
    {"nameless_file", [] { return error_of(open(".", O_TMPFILE | O_WRONLY, 0600)); }},
    {"write_file", [] { return error_of(open("old", O_WRONLY)); }},
    {"empty_file", [] { return error_of(truncate("old", 0)); }},
    {"read_file", [] { return error_of(open("old", O_RDONLY)); }},
    {"list_folder", [] { return opendir(".") ? 0 : errno; }},
    {"make_folder", [] { return error_of(mkdir("folder", 0700)); }},
    {"remove_file", [] { return error_of(unlink("old")); }},
    {"rename_file", [] { return error_of(rename("old", "new")); }},
    {"link_file", [] { return error_of(link("old", "new")); }},
    {"symbolic_link", [] { return error_of(symlink("old", "new")); }},
    {"process", forked},
    {"program", executed},
    {"shell", [] { return system("true") == 0 ? 0 : errno; }},
    {"signal_parent", [] { return error_of(kill(getppid(), SIGCONT)); }},
    {"signal_by_pipe", pipe_owned_by_parent},
    {"signal_of_choice", pipe_with_a_signal},
    {"limit", limit_raised},
    {"code", code_made},
    {"much_memory", [] { return memory_of(kLimit_bytes + (std::uint64_t(1) << 30)); }},
    {"much_shared_memory", [] { return shared_memory_of(kLimit_bytes + 1); }},
    // What decoding needs.
    {"some_memory", [] { return memory_of(kLimit_bytes / 2); }},
    {"some_shared_memory", [] { return shared_memory_of(kLimit_bytes); }},
    {"own_memory", opened_again},
    {"thread", thread_started},
    {"pipe",
     [] {
         int ends[2];
         return error_of(pipe(ends));
     }},
};

int run_as_on_an_old_kernel(char** command) {
    scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ALLOW);
    const bool good = filter && seccomp_rule_add(filter, SCMP_ACT_ERRNO(ENOSYS), SCMP_SYS(seccomp), 0) == 0 &&
                      seccomp_rule_add(filter, SCMP_ACT_ERRNO(ENOSYS), SCMP_SYS(landlock_create_ruleset), 0) == 0 &&
                      seccomp_rule_add(filter, SCMP_ACT_ERRNO(EINVAL), SCMP_SYS(prctl), 1,
                                       SCMP_A0(SCMP_CMP_EQ, PR_SET_SECCOMP)) == 0 &&
                      seccomp_load(filter) == 0;
    if (!good) return 250;
    execve(command[0], command, environ);
    return errno;
}

}  // namespace

int main(int count, char** arguments) {
    if (count > 2 && std::strcmp(arguments[1], "--old-kernel") == 0) return run_as_on_an_old_kernel(arguments + 2);
    const auto attempt = kAttempts.find(count > 1 ? arguments[1] : "");
    if (attempt == kAttempts.end()) {
        std::fputs("confined_probe: no such attempt\n", stderr);
        return 251;
    }
    if (count == 2) {
        dstylize::sandbox::limit_resources(kLimit_bytes);
        const auto held = dstylize::sandbox::confine();
        if (!held.system_calls || !held.files) return 250;
    }
    _exit(attempt->second());
}
