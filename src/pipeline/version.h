#pragma once
#include <string_view>

namespace dstylize {

/// "0.1.0": the version of this library, which recipes name.
std::string_view version();

}  // namespace dstylize
