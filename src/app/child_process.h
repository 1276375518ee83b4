#pragma once
#include <string>
#include <vector>

namespace dstylize::app {

/// Runs a program, which is looked for in PATH, with these words as they are, without a shell, and returns what it
/// writes to standard output. Throws Error(failed) when it cannot be started or does not end with 0; what it says on
/// standard error has been seen then.
std::string output_of(const std::vector<std::string>& command);

}  // namespace dstylize::app
