#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "support/process.h"

namespace dstylize::test {

/// What tests/fault/fault_shim.cpp is to do to a run.
struct Fault {
    const char* calls = "files";  ///< or "memory"
    long at = 0;                  ///< the call that goes wrong, from 1; 0 for none
    int error = 0;                ///< its errno; 0 kills the program there
};

/// Runs dstylize with a fault, to its end; an exit code of 1000 + n is signal n.
inline Outcome dstylize_with(Fault fault, std::vector<std::string> arguments, const std::filesystem::path& folder,
                             const std::filesystem::path& log = "") {
    std::vector<std::string> command{"/usr/bin/env",
                                     "LD_PRELOAD=" DSTYLIZE_FAULT_SHIM,
                                     std::string("FAULT_CALLS=") + fault.calls,
                                     "FAULT_AT=" + std::to_string(fault.at),
                                     "FAULT=" + std::to_string(fault.error),
                                     "FAULT_LOG=" + log.string(),
                                     DSTYLIZE_PROGRAM};
    command.insert(command.end(), arguments.begin(), arguments.end());
    Process process(std::move(command), folder);
    const int exit_code = process.wait();
    return {exit_code, process.out(), process.err()};
}

/// The number of calls that could go wrong in a run, which is made.
inline long calls_of(const char* calls, const std::vector<std::string>& arguments,
                     const std::filesystem::path& folder) {
    const TempFolder logs;
    dstylize_with({calls}, arguments, folder, logs / "log");
    const std::string log = file_bytes(logs / "log");
    return std::count(log.begin(), log.end(), '\n');
}

}  // namespace dstylize::test
