#include "codec/supervisor.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <string>
#include <thread>

#include "ipc/channel.h"
#include "ipc/codec_protocol.h"

namespace dstylize::codec {
namespace {

/// A supervisor in a process of its own, whose workers do this; the test has the other end of its channel.
class Supervised {
  public:
    using Worker = WorkerEnd (*)(const ipc::Descriptor& channel, std::atomic<bool>& busy);
    static constexpr int kReturned = 42;

    explicit Supervised(Worker worker) {
        auto [ours, theirs] = ipc::connected_pair();
        pid_ = fork();
        if (pid_ == 0) {
            ours = {};
            supervise(theirs, [&, &channel = theirs](std::atomic<bool>& busy, sandbox::Confinement) {
                return worker(channel, busy);
            });
            _exit(kReturned);
        }
        channel = std::move(ours);
    }
    ~Supervised() {
        if (pid_ <= 0) return;
        kill(pid_, SIGKILL);
        waitpid(pid_, nullptr, 0);
    }
    /// Its exit status, or -1 if it goes on for ten seconds.
    int exit_status() {
        for (int tenths = 0; tenths < 100; ++tenths) {
            int status = 0;
            if (waitpid(pid_, &status, WNOHANG) == pid_) {
                pid_ = -1;
                return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        }
        return -1;
    }
    ipc::Descriptor channel;

  private:
    pid_t pid_ = -1;
};

TEST(Supervisor, GivesUpWhenNoWorkerStarts) {
    Supervised s([](const ipc::Descriptor&, std::atomic<bool>&) { return WorkerEnd(66); });
    EXPECT_EQ(s.exit_status(), Supervised::kReturned);
}

TEST(Supervisor, ReportsEveryCrashAndGoesOnUntilTheChannelCloses) {
    Supervised s([](const ipc::Descriptor& channel, std::atomic<bool>& busy) {
        ipc::CodecRequest request;
        ipc::Descriptor none;
        if (ipc::receive_struct(channel, request, none) != ipc::Arrival::message) return WorkerEnd::channel_closed;
        busy = true;
        return WorkerEnd(66);
    });
    for (int k = 0; k < 5; ++k) {
        ASSERT_TRUE(ipc::send_struct(s.channel, ipc::CodecRequest{}));
        ipc::CodecAnswer answer;
        ipc::Descriptor none;
        ASSERT_EQ(ipc::receive_struct(s.channel, answer, none, 10000), ipc::Arrival::message);
        EXPECT_EQ(answer.status, ipc::CodecStatus::crashed);
        EXPECT_EQ(std::string(answer.problem), "exit status 66");
    }
    s.channel = {};
    EXPECT_EQ(s.exit_status(), Supervised::kReturned);
}

}  // namespace
}  // namespace dstylize::codec
