#include "codec/supervisor.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <new>
#include <thread>

#include "ipc/channel.h"
#include "ipc/codec_protocol.h"

namespace dstylize::codec {
namespace {

/// Ends this process as soon as the other end of the channel is gone, whatever it does then.
void end_with(const ipc::Descriptor& channel) {
    std::thread([number = channel.number()] {
        pollfd hangup{number, 0, 0};
        while (poll(&hangup, 1, -1) < 0) continue;
        _exit(int(WorkerEnd::channel_closed));
    }).detach();
}

/// A flag that a child shares with this process.
std::atomic<bool>& shared_flag() {
    void* page = mmap(nullptr, sizeof(std::atomic<bool>), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (page == MAP_FAILED) throw std::bad_alloc();
    return *new (page) std::atomic<bool>(false);
}

int waited_for(pid_t child) {
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
    return status;
}

void report_crash(const ipc::Descriptor& channel, int status) {
    const std::string how = WIFSIGNALED(status)
                                ? fmt::format("signal {}, {}", WTERMSIG(status), strsignal(WTERMSIG(status)))
                                : fmt::format("exit status {}", WEXITSTATUS(status));
    ipc::CodecAnswer answer;
    answer.status = ipc::CodecStatus::crashed;
    how.copy(answer.problem, sizeof(answer.problem) - 1);
    ipc::send_struct(channel, answer);
}

}  // namespace

void supervise(const ipc::Descriptor& channel,
               const std::function<WorkerEnd(std::atomic<bool>& busy, sandbox::Confinement held)>& work) {
    constexpr int kMostIdleDeaths = 3;
    std::atomic<bool>& busy = shared_flag();
    for (int idle_deaths = 0; idle_deaths < kMostIdleDeaths;) {
        busy = false;
        const pid_t child = fork();
        if (child < 0) return;
        if (child == 0) {
            prctl(PR_SET_PDEATHSIG, SIGKILL);
            const sandbox::Confinement held = sandbox::confine();  // before there are other threads
            end_with(channel);
            // No destructors: after a hostile file they could crash or hang.
            _exit(int(work(busy, held)));
        }
        const int status = waited_for(child);
        const bool ended = WIFEXITED(status);
        if (ended && WEXITSTATUS(status) == int(WorkerEnd::channel_closed)) return;
        const bool idle = !busy && !(ended && WEXITSTATUS(status) == int(WorkerEnd::retired));
        idle_deaths = idle ? idle_deaths + 1 : 0;
        if (busy) report_crash(channel, status);
    }
}

}  // namespace dstylize::codec
