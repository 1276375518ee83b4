#include "formats/codec_process.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <system_error>
#include <vector>

#include "core/error.h"

extern char** environ;

namespace dstylize {
namespace {

constexpr int kStartTimeout_ms = 60'000;

[[noreturn]] void cannot_start(const std::filesystem::path& program, const std::string& why) {
    throw Error(ErrorCode::failed, program.string(), "the picture codec cannot be started (" + why + ")",
                "install dstylize again, or give the path of dstylize-codec");
}

std::filesystem::path this_program() {
    std::error_code ignored;
    return std::filesystem::read_symlink("/proc/self/exe", ignored);
}

std::filesystem::path this_library() {
    Dl_info info{};
    return dladdr(reinterpret_cast<void*>(&codec_program), &info) && info.dli_fname ? info.dli_fname : "";
}

/// posix_spawn's attributes, freed at the end of the scope.
struct SpawnPlan {
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    SpawnPlan() {
        posix_spawn_file_actions_init(&files);
        posix_spawnattr_init(&attributes);
    }
    SpawnPlan(const SpawnPlan&) = delete;
    SpawnPlan& operator=(const SpawnPlan&) = delete;
    ~SpawnPlan() {
        posix_spawn_file_actions_destroy(&files);
        posix_spawnattr_destroy(&attributes);
    }
};

}  // namespace

std::filesystem::path codec_program(const std::filesystem::path& asked) {
    if (!asked.empty()) return asked;
    std::vector<std::filesystem::path> folders;
    for (const std::filesystem::path& from : {this_program(), this_library()}) {
        if (from.empty()) continue;
        const std::filesystem::path folder = from.parent_path();
        // The last one is for libraries in lib/x86_64-linux-gnu.
        for (const char* where : {"", "../libexec/dstylize", "../../libexec/dstylize"})
            folders.push_back((folder / where).lexically_normal());
    }
    for (const auto& folder : folders)
        if (::access((folder / "dstylize-codec").c_str(), X_OK) == 0) return folder / "dstylize-codec";
    cannot_start(folders.empty() ? "dstylize-codec" : folders.front() / "dstylize-codec", "it is not there");
}

CodecProcess::CodecProcess(const std::filesystem::path& program, std::uint64_t max_memory_bytes) : program_(program) {
    auto [ours, theirs] = ipc::connected_pair();
    SpawnPlan plan;
    for (const int number : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})  // libpng writes to standard error
        posix_spawn_file_actions_addopen(&plan.files, number, "/dev/null", O_RDWR, 0);
    ipc::Descriptor moved;
    if (theirs.number() == ipc::kCodecChannel) {
        // dup2 onto itself would keep close-on-exec.
        moved = ipc::Descriptor(::fcntl(theirs.number(), F_DUPFD_CLOEXEC, ipc::kCodecChannel + 1));
        if (!moved) cannot_start(program_, std::strerror(errno));
    }
    posix_spawn_file_actions_adddup2(&plan.files, (moved ? moved : theirs).number(), ipc::kCodecChannel);
    // Its own process group, so that Ctrl-C reaches only us; default signals and none blocked, whatever
    // our caller did.
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    posix_spawnattr_setflags(&plan.attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    posix_spawnattr_setpgroup(&plan.attributes, 0);
    posix_spawnattr_setsigmask(&plan.attributes, &none);
    posix_spawnattr_setsigdefault(&plan.attributes, &all);

    std::string path = program_.string(), limit = std::to_string(max_memory_bytes);
    char* arguments[] = {path.data(), limit.data(), nullptr};
    if (const int error = posix_spawn(&pid_, path.c_str(), &plan.files, &plan.attributes, arguments, environ)) {
        pid_ = -1;
        cannot_start(program_, std::strerror(error));
    }
    channel_ = std::move(ours);
}

CodecProcess::~CodecProcess() { end(); }

CodecProcess::Outcome CodecProcess::ask(const ipc::CodecRequest& request, const ipc::Descriptor& payload,
                                        ipc::CodecAnswer& answer, ipc::Descriptor& answer_payload, double timeout_s) {
    if (!greeted_) await_greeting();
    if (!ipc::send_struct(channel_, request, payload.number())) return Outcome::was_dead;
    const int timeout_ms = timeout_s <= 0 ? -1 : int(std::min(std::ceil(timeout_s * 1000), 2e9));
    switch (ipc::receive_struct(channel_, answer, answer_payload, timeout_ms)) {
        case ipc::Arrival::message: return Outcome::answered;
        case ipc::Arrival::timeout: return Outcome::timed_out;
        case ipc::Arrival::hangup: break;
    }
    return Outcome::died;
}

void CodecProcess::await_greeting() {
    ipc::CodecGreeting greeting{};
    ipc::Descriptor none;
    if (ipc::receive_struct(channel_, greeting, none, kStartTimeout_ms) != ipc::Arrival::message)
        cannot_start(program_, cause_of_death());
    if (greeting.protocol != ipc::kCodecProtocol) cannot_start(program_, "it is of another version");
    greeted_ = true;
}

std::string CodecProcess::cause_of_death() {
    end();
    if (WIFSIGNALED(wait_status_))
        return fmt::format("signal {}, {}", WTERMSIG(wait_status_), strsignal(WTERMSIG(wait_status_)));
    return fmt::format("exit status {}", WEXITSTATUS(wait_status_));
}

void CodecProcess::end() {
    if (pid_ <= 0) return;
    // The closed channel ends its worker, and then itself. Only while it still loads, or when it is stuck,
    // it is killed; its worker dies with it.
    channel_.reset();
    constexpr int kPatience_ms = 1000;
    for (int waited_ms = 0; waited_ms < kPatience_ms && greeted_ && !reaped(WNOHANG); ++waited_ms) ::usleep(1000);
    if (pid_ > 0 && !reaped(WNOHANG)) {
        ::kill(pid_, SIGKILL);
        reaped(0);
    }
}

bool CodecProcess::reaped(int wait_options) {
    pid_t reaped;
    do reaped = ::waitpid(pid_, &wait_status_, wait_options);
    while (reaped < 0 && errno == EINTR);
    if (reaped != 0) pid_ = -1;
    return reaped != 0;
}

}  // namespace dstylize
