#include "app/progress.h"

#include <cstdio>
#include <stop_token>

#include "app/progress_text.h"

namespace dstylize::app {
namespace {

using namespace std::chrono_literals;
constexpr auto kSilentFor = 1s;
constexpr auto kRedraw = 200ms;
constexpr const char* kClearLine = "\r\033[K";

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

Progress::Progress(bool shows_line) {
    if (shows_line) drawer_ = std::jthread([this](const std::stop_token& stop) { keep_drawing(stop); });
}

Progress::~Progress() { finish(); }

void Progress::begin(std::string_view step, double share_done) {
    const std::scoped_lock lock(mutex_);
    end_step();
    steps_.emplace_back(step, 0.0);
    share_done_ = share_done;
    left_at_step_start_ = seconds_left(share_done, seconds_since(start_));
}

void Progress::end_step() {
    const Clock::time_point now = Clock::now();
    if (!steps_.empty()) steps_.back().second = std::chrono::duration<double>(now - step_start_).count();
    step_start_ = now;
}

void Progress::finish() {
    if (is_finished_) return;
    is_finished_ = true;
    if (drawer_.joinable()) {
        drawer_.request_stop();
        drawer_.join();
    }
    const std::scoped_lock lock(mutex_);
    end_step();
    finished_ = step_start_;
}

double Progress::seconds() const { return std::chrono::duration<double>(finished_ - start_).count(); }

void Progress::keep_drawing(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    wake_.wait_for(lock, stop, kSilentFor, [] { return false; });
    while (!stop.stop_requested()) {
        if (!steps_.empty()) {
            const double left = left_at_step_start_ - seconds_since(step_start_);
            std::fputs((kClearLine + progress_text(steps_.back().first, share_done_, left)).c_str(), stderr);
            std::fflush(stderr);
            is_drawn_ = true;
        }
        wake_.wait_for(lock, stop, kRedraw, [] { return false; });
    }
    clear();
}

void Progress::clear() {
    if (!is_drawn_) return;
    std::fputs(kClearLine, stderr);
    std::fflush(stderr);
    is_drawn_ = false;
}

}  // namespace dstylize::app
