#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "app/commands.h"
#include "app/progress.h"
#include "pipeline/batch_report.h"
#include "pipeline/style_file.h"

namespace dstylize::app {
namespace {

using State = BatchPicture::State;

BatchRequest batch_request(const Arguments& arguments) {
    BatchRequest batch;
    batch.each = draw_request(arguments);
    batch.input = batch.each.input;
    if (arguments.names.size() > 1) {
        batch.output = arguments.names[1];
        batch.each.outputs.erase(batch.each.outputs.begin());
    }
    batch.patterns = arguments.patterns;
    batch.codec = codec_options(arguments);
    return batch;
}

std::string summary(const BatchRequest& batch, const BatchReport& report, double seconds) {
    std::string out;
    for (const BatchPicture& picture : report.pictures)
        if (picture.state == State::failed) out += fmt::format("failed       {}\n", picture.input);
    out += fmt::format("{:<12} {:>6}\nup to date   {:>6}\nfailed       {:>6}\n",
                       batch.each.dry_run ? "to be drawn" : "drawn", report.count(State::done),
                       report.count(State::up_to_date), report.count(State::failed));
    if (batch.each.dry_run) return out;
    return out + fmt::format("in {:.1f} s; see {}\n", seconds, (batch.output / "index.html").string());
}

/// One batch; the bars of several follow each other.
BatchReport run_and_tell(const BatchRequest& batch, const Arguments& arguments, Interrupt& interrupt) {
    Progress progress(!arguments.quiet && ::isatty(STDERR_FILENO) == 1);
    Work work;
    work.stop = interrupt.token();
    work.threads = arguments.threads;
    BatchReport report = run_batch(
        batch,
        [&](const BatchProgress& now) {
            interrupt.set_writing(now.writing);
            if (!now.picture) return;
            progress.begin(fmt::format("{} of {} pictures", now.finished, now.total),
                           double(now.finished) / double(now.total));
            if (now.picture->state == State::failed)
                print_error({ErrorCode::failed, (batch.input / now.picture->input).string(), now.picture->problem,
                             now.picture->remedy});
        },
        work);
    progress.finish();
    if (!arguments.json && (!arguments.quiet || batch.each.dry_run)) print(summary(batch, report, progress.seconds()));
    return report;
}

/// A batch for each style; the results of several lie in a folder each.
std::vector<BatchRequest> batches(const Arguments& arguments) {
    BatchRequest batch = batch_request(arguments);
    if (arguments.styles.size() < 2 || batch.output.empty()) return {batch};
    std::vector<BatchRequest> out;
    batch.leave_out = batch.output;
    for (const std::string& style : arguments.styles) {
        batch.each.style = style;
        batch.output = batch.leave_out / load_style(style, batch.each.settings, batch.each.user_styles).name;
        for (const BatchRequest& other : out)
            if (other.output == batch.output)
                throw Error(ErrorCode::bad_usage, "--style " + style, "is given twice", "leave one of them out");
        out.push_back(batch);
    }
    return out;
}

}  // namespace

ExitCode draw_folder(const Arguments& arguments) {
    const std::vector<BatchRequest> requests = batches(arguments);
    Interrupt interrupt;
    ExitCode code = kDone;
    std::vector<BatchReport> reports;
    for (const BatchRequest& batch : requests) {
        reports.push_back(run_and_tell(batch, arguments, interrupt));
        if (reports.back().count(State::failed) > 0) code = kSomeFailed;
    }
    if (arguments.json) print(batch_report_json(reports));
    return code;
}

}  // namespace dstylize::app
