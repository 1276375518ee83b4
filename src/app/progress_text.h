#pragma once
#include <string>
#include <string_view>

namespace dstylize::app {

/// Seconds that the rest of a run will take if it goes on as it went, or 0 as long as too little is done to tell.
double seconds_left(double share_done, double elapsed_s);

/// "3 of 10 pictures · 30 % · 12 min left", without the last part for less than a second.
std::string progress_text(std::string_view step, double share_done, double left_s);

}  // namespace dstylize::app
