#include "app/interrupt.h"

#include <signal.h>
#include <unistd.h>

#include "core/work.h"

namespace dstylize::app {
namespace {

constexpr long kPoll_ns = 100'000'000;
constexpr int kPollsUntilEnd = 10;

sigset_t watched_signals() {
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGINT);
    sigaddset(&set, SIGTERM);
    sigaddset(&set, SIGUSR1);  // our own: the run is over
    return set;
}

}  // namespace

Interrupt::Interrupt() {
    const sigset_t set = watched_signals();
    pthread_sigmask(SIG_BLOCK, &set, nullptr);
    watcher_ = std::jthread([this](const std::stop_token& done) { watch(done); });
}

Interrupt::~Interrupt() {
    watcher_.request_stop();
    pthread_kill(watcher_.native_handle(), SIGUSR1);
}

void Interrupt::check() const {
    Work work;
    work.stop = token();
    work.check();
}

void Interrupt::watch(const std::stop_token& done) {
    const sigset_t set = watched_signals();
    int signal = 0;
    do sigwait(&set, &signal);
    while (signal == SIGUSR1 && !done.stop_requested());
    if (signal == SIGUSR1) return;
    stop_.request_stop();
    const timespec poll{0, kPoll_ns};
    for (int polls = 0; !done.stop_requested();) {
        const int again = sigtimedwait(&set, nullptr, &poll);
        const bool impatient = again == SIGINT || again == SIGTERM || ++polls >= kPollsUntilEnd;
        if (impatient && !writing_ && !done.stop_requested()) ::_exit(kExitCode);
    }
}

}  // namespace dstylize::app
