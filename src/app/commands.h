#pragma once
#include <string>

#include "app/interrupt.h"
#include "app/options.h"
#include "core/error.h"

namespace dstylize::app {

/// Exit codes, as the manual lists them.
enum ExitCode {
    kDone = 0,
    kFailed = 1,
    kWrongUsage = 2,
    kInputUnreadable = 3,
    kOutputUnwritable = 4,
    kSomeFailed = 5,
    kInterrupted = 130
};
ExitCode exit_code(ErrorCode code);

/// Each runs one form of the program to its end. They throw Error. A folder of pictures may end with some of them
/// failed.
ExitCode draw(const Arguments& arguments);
ExitCode draw_folder(const Arguments& arguments);
void write(const Arguments& arguments);
void replay(const Arguments& arguments);
void list_styles(const Arguments& arguments);

/// Runs one request, with progress and reports as the arguments say. Refuses folders as input. Throws Error.
RunReport run_and_report(const RunRequest& request, const Arguments& arguments, PictureCodec& codec,
                         Interrupt& interrupt);
CodecOptions codec_options(const Arguments& arguments);
void refuse_folder(const std::filesystem::path& input);

/// Where a user keeps styles of their own: dstylize/styles in the XDG configuration folder; empty without a home.
std::filesystem::path user_style_folder();

/// One line on standard error, whatever is in the file's name.
void print_error(const Error& error);
/// Writes to standard output. Throws Error(cannot_write).
void print(const std::string& text);

}  // namespace dstylize::app
