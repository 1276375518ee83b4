#pragma once
#include <functional>
#include <string>
#include <utility>

#include "app/interrupt.h"
#include "app/options.h"
#include "core/error.h"
#include "pipeline/batch.h"

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
/// Draws what comes into a folder until it is interrupted, which it throws as Error(cancelled).
[[noreturn]] ExitCode watch_folder(const Arguments& arguments);
ExitCode merge_reports(const Arguments& arguments);
/// `parser` is the one that read the arguments.
void write_slurm_jobs(const Arguments& arguments, const Parser& parser);
void write(const Arguments& arguments);
void replay(const Arguments& arguments);
void list_styles(const Arguments& arguments);

/// Runs one request, with progress and reports as the arguments say. Refuses folders as input. Throws Error.
RunReport run_and_report(const RunRequest& request, const Arguments& arguments, PictureCodec& codec,
                         Interrupt& interrupt);
void refuse_folder(const std::filesystem::path& input);

/// One batch, with progress on the terminal and a line on standard error for each picture that fails; `tell` hears of
/// each that is finished. Returns its report and how many seconds it took. Throws Error.
std::pair<BatchReport, double> run_folder(const BatchRequest& batch, const Arguments& arguments, Interrupt& interrupt,
                                          const std::function<void(const BatchPicture&)>& tell = {});
/// The table of a batch: what failed, and how many pictures were drawn or not.
std::string folder_summary(const BatchReport& report, bool dry_run);

/// Where a user keeps styles of their own: dstylize/styles in the XDG configuration folder; empty without a home.
std::filesystem::path user_style_folder();

/// One line on standard error, whatever is in the file's name.
void print_error(const Error& error);
/// Writes to standard output. Throws Error(cannot_write).
void print(const std::string& text);

}  // namespace dstylize::app
