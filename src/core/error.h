#pragma once
#include <stdexcept>
#include <string>
#include <utility>

namespace dstylize {

/// What went wrong, as the caller can act on it; the command line maps each to one exit code.
enum class ErrorCode {
    failed,        ///< the run failed although nothing in the request is wrong
    bad_usage,     ///< an option, style file, root or size is wrong
    cannot_read,   ///< an input is missing, unsupported, damaged or over the limits
    cannot_write,  ///< an output cannot be written
    cancelled,     ///< the caller asked to stop
};

/// The library's one exception type: whom it concerns, what is wrong, what to do about it.
class Error : public std::runtime_error {
  public:
    /// `file` may be empty when no file is concerned. `what()` is "file: problem: remedy".
    Error(ErrorCode code, std::string file, std::string problem, std::string remedy)
        : std::runtime_error((file.empty() ? "" : file + ": ") + problem + (remedy.empty() ? "" : ": " + remedy)),
          code_(code),
          file_(std::move(file)),
          problem_(std::move(problem)),
          remedy_(std::move(remedy)) {}
    ErrorCode code() const { return code_; }
    const std::string& file() const { return file_; }
    const std::string& problem() const { return problem_; }
    const std::string& remedy() const { return remedy_; }

  private:
    ErrorCode code_;
    std::string file_, problem_, remedy_;
};

}  // namespace dstylize
