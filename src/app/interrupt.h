#pragma once
#include <atomic>
#include <stop_token>
#include <thread>

namespace dstylize::app {

/// Turns SIGINT and SIGTERM into a stop request. Make it before any other thread, so that all of them
/// leave the signals to its own. A run that does not heed the request within a second (a picture is being
/// decoded) is ended, unless it is just writing: then nothing is left half-written either way.
class Interrupt {
  public:
    static constexpr int kExitCode = 130;

    Interrupt();
    ~Interrupt();
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;

    std::stop_token token() const { return stop_.get_token(); }
    /// Throws Error(cancelled) once a stop was requested.
    void check() const;
    /// While set, a stop waits for the run to come to an end by itself.
    void set_writing(bool writing) { writing_ = writing; }

  private:
    void watch(const std::stop_token& done);

    std::stop_source stop_;
    std::atomic<bool> writing_ = false;
    std::jthread watcher_;
};

}  // namespace dstylize::app
