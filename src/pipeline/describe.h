#pragma once
#include <string>

namespace dstylize {

/// What `dstylize styles` prints: every built-in style and its summary, a line for each.
std::string styles_description();

/// What `dstylize styles --fields` prints: every field that a style or --show can name, and what it is.
std::string fields_description();

}  // namespace dstylize
