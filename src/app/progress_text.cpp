#include "app/progress_text.h"

#include <fmt/format.h>

namespace dstylize::app {
namespace {

std::string time_text(double seconds) {
    constexpr double kMinute_s = 60, kHour_s = 3600;
    if (seconds < 2 * kMinute_s) return fmt::format("{:.0f} s", seconds);
    if (seconds < 2 * kHour_s) return fmt::format("{:.0f} min", seconds / kMinute_s);
    return fmt::format("{:.0f} h", seconds / kHour_s);
}

}  // namespace

double seconds_left(double share_done, double elapsed_s) {
    constexpr double kShareThatTells = 0.05, kSecondsThatTell = 10;  // either is enough
    const bool tells = share_done > kShareThatTells || (share_done > 0 && elapsed_s > kSecondsThatTell);
    return tells ? elapsed_s / share_done - elapsed_s : 0;
}

std::string progress_text(std::string_view step, double share_done, double left_s) {
    constexpr std::size_t kLongestStep = 50;  // of a line that must not wrap
    std::string line = fmt::format("{} · {:.0f} %", step.substr(0, kLongestStep), 100 * share_done);
    if (left_s >= 1) line += " · " + time_text(left_s) + " left";
    return line;
}

}  // namespace dstylize::app
