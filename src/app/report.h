#pragma once
#include <string>

#include "app/progress.h"
#include "core/error.h"
#include "pipeline/run.h"

namespace dstylize::app {

/// The --json report of a run, or of why there was none.
std::string json_report(const RunReport& report, const Progress& progress);
std::string json_report(const Error& error, int exit_code);

/// What --verbose says: times and counts, a line for each.
std::string verbose_report(const RunReport& report, const Progress& progress);

/// What --verbose says of a picture of a folder that was drawn: the same in a few lines.
std::string brief_report(const RunReport& report, const Progress& progress);

/// What --dry-run says.
std::string dry_run_report(const RunReport& report);

}  // namespace dstylize::app
