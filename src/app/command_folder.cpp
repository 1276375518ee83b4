#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "app/commands.h"
#include "app/progress.h"
#include "pipeline/batch_report.h"

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

}  // namespace

ExitCode draw_folder(const Arguments& arguments) {
    const BatchRequest batch = batch_request(arguments);
    Interrupt interrupt;
    Progress progress(!arguments.quiet && ::isatty(STDERR_FILENO) == 1);
    Work work;
    work.stop = interrupt.token();
    work.threads = arguments.threads;
    const BatchReport report = run_batch(
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
    if (arguments.json)
        print(batch_report_json(report));
    else if (!arguments.quiet)
        print(summary(batch, report, progress.seconds()));
    return report.count(State::failed) > 0 ? kSomeFailed : kDone;
}

}  // namespace dstylize::app
