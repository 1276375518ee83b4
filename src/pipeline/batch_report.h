#pragma once
#include <filesystem>
#include <span>
#include <string>

#include "pipeline/batch.h"

namespace dstylize {

/// Where the small copies of a picture and of its drawing lie, from the output folder.
std::filesystem::path thumbnail_before(const BatchPicture& picture);
std::filesystem::path thumbnail_after(const BatchPicture& picture);

/// The report of a batch for programs.
std::string batch_report_json(const BatchReport& report);
/// Of one batch the same; of several a list.
std::string batch_report_json(std::span<const BatchReport> reports);
/// The same for people: a page that shows every picture beside its result, what failed first, and counts those that
/// were not reached. It names files by their paths from `output`, where it is to lie.
std::string contact_sheet_html(const BatchReport& report, const std::filesystem::path& input,
                               const std::filesystem::path& output);

/// Whether write_batch_reports() may write there: no link leads it elsewhere, and no file of others is in its place,
/// unless `force` is given. Throws Error(cannot_write), Error(bad_usage).
void check_batch_reports(const std::filesystem::path& output, bool force);

/// Both as report.json and index.html in the output folder. Throws Error(cannot_write).
void write_batch_reports(const BatchReport& report, const std::filesystem::path& input,
                         const std::filesystem::path& output);

}  // namespace dstylize
