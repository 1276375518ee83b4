#include <fmt/format.h>

#include "app/commands.h"
#include "pipeline/batch_report.h"
#include "pipeline/shard_reports.h"

namespace dstylize::app {

ExitCode merge_reports(const Arguments& arguments) {
    if (arguments.names.empty())
        throw Error(ErrorCode::bad_usage, "merge-reports", "wants a folder of drawings",
                    "write dstylize merge-reports OUT");
    ExitCode code = kDone;
    std::vector<BatchReport> reports;
    for (const std::filesystem::path output : arguments.names) {
        reports.push_back(merge_shards(output));
        if (reports.back().count(BatchPicture::State::failed) > 0) code = kSomeFailed;
        if (!arguments.json && !arguments.quiet)
            print(folder_summary(reports.back(), false) + fmt::format("see {}\n", (output / "index.html").string()));
    }
    if (arguments.json) print(batch_report_json(reports));
    return code;
}

}  // namespace dstylize::app
