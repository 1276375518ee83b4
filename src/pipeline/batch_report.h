#pragma once
#include <filesystem>
#include <string>

#include "pipeline/batch.h"

namespace dstylize {

/// The report of a batch for programs.
std::string batch_report_json(const BatchReport& report);
/// The same for people: a page that shows every picture beside its result, what failed first. It names files by their
/// paths from `output`, where it is to lie.
std::string contact_sheet_html(const BatchReport& report, const std::filesystem::path& input,
                               const std::filesystem::path& output);

}  // namespace dstylize
