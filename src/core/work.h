#pragma once
#include <functional>
#include <stop_token>
#include <string_view>

#include "core/error.h"

namespace dstylize {

/// How a run talks to its caller: cancellation, progress, threads. Passed last to whatever can take
/// long. The library itself never prints, exits or reads the clock.
struct Work {
    std::stop_token stop;
    /// Called with the name of the step that begins and the share of the whole run done, in [0, 1].
    std::function<void(std::string_view step, double share_done)> progress;
    /// Threads to use; 0 means as many as the machine has. Results never depend on it.
    int threads = 0;

    void report(std::string_view step, double share_done) const {
        check();
        if (progress) progress(step, share_done);
    }
    /// Throws Error(cancelled) when the caller asked to stop.
    void check() const {
        if (stop.stop_requested()) throw Error(ErrorCode::cancelled, "", "interrupted", "");
    }
};

}  // namespace dstylize
