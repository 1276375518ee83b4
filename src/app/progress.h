#pragma once
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace dstylize::app {

/// Takes the steps that a run reports: keeps how long each took and, on a terminal, shows a line that says
/// what is being done, which share is done and how long it will take, once a run takes over a second.
class Progress {
  public:
    explicit Progress(bool shows_line);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void begin(std::string_view step, double share_done);
    /// Calls it while the line is off the terminal: what it writes there stands on a line of its own.
    template <class Write>
    void beside(Write write) {
        const std::scoped_lock lock(mutex_);
        clear();
        write();
    }
    /// Ends the last step and takes the line off the terminal.
    void finish();

    double seconds() const;
    /// Each step and its seconds, in the order of their beginnings.
    const std::vector<std::pair<std::string, double>>& steps() const { return steps_; }

  private:
    using Clock = std::chrono::steady_clock;
    void keep_drawing(const std::stop_token& stop);
    void end_step();
    void clear();

    const Clock::time_point start_ = Clock::now();
    Clock::time_point step_start_ = start_, finished_ = start_;
    std::vector<std::pair<std::string, double>> steps_;
    double share_done_ = 0, left_at_step_start_ = 0;
    bool is_finished_ = false, is_drawn_ = false;
    std::mutex mutex_;
    std::condition_variable_any wake_;
    std::jthread drawer_;
};

}  // namespace dstylize::app
