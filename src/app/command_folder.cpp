#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <map>

#include "app/commands.h"
#include "app/progress.h"
#include "app/report.h"
#include "app/requests.h"
#include "pipeline/batch_report.h"
#include "pipeline/shard_reports.h"

namespace dstylize::app {
namespace {

using State = BatchPicture::State;

/// A shard that was stopped has none, which tells that it must be run again; and what has done nothing leaves those of
/// the run before.
bool has_reports(const BatchRequest& batch, const BatchReport& report) {
    const std::size_t not_reached = report.count(State::not_reached);
    return !batch.each.dry_run && (not_reached == 0 || (!batch.shard && not_reached < report.pictures.size()));
}

/// Writes the reports, and returns the one that a person should see.
std::filesystem::path write_reports(const BatchRequest& batch, const BatchReport& report) {
    if (batch.shard) {
        write_shard_report(report, batch.input, batch.output, *batch.shard);
        return shard_report(batch.output, *batch.shard);
    }
    write_batch_reports(report, batch.input, batch.output);
    return batch.output / "index.html";
}

/// What --verbose says of each picture, from what the batch tells.
class VerboseFolder {
  public:
    explicit VerboseFolder(const BatchRequest& batch) : batch_(batch) {}

    void hear(const BatchProgress& now) {
        if (!now.at_work || now.step.empty()) return;
        if (now.step == "reading") at_work_.erase(now.at_work);  // also of one that is read once more
        at_work_.try_emplace(now.at_work, false).first->second.begin(now.step, 0);
    }

    /// Of a picture that has been finished; nothing of one that failed, which has a line of its own.
    std::string said(const BatchProgress& now) {
        const auto times = at_work_.extract(now.picture);
        if (now.drawn) {
            times.mapped().finish();
            return brief_report(*now.drawn, times.mapped());
        }
        if (now.picture->state == State::failed) return {};
        return fmt::format("{}: {}\n", (batch_.input / now.picture->input).string(),
                           now.picture->state == State::up_to_date ? "up to date" : "to be drawn");
    }

  private:
    const BatchRequest& batch_;
    std::map<const BatchPicture*, Progress> at_work_;
};

BatchReport draw_batch(const BatchRequest& batch, const Arguments& arguments, Interrupt& interrupt) {
    const bool dry_run = batch.each.dry_run;
    if (batch.shard && !dry_run) remove_shard_report(batch.output, *batch.shard);
    auto [report, seconds] = run_folder(batch, arguments, interrupt);
    std::string text = folder_summary(report, dry_run);
    if (has_reports(batch, report)) {
        interrupt.set_writing(true);
        text += fmt::format("in {:.1f} s; see {}\n", seconds, write_reports(batch, report).string());
        interrupt.set_writing(false);
    }
    if (!arguments.json && (!arguments.quiet || dry_run)) print(text);
    interrupt.check();
    return std::move(report);
}

}  // namespace

std::string folder_summary(const BatchReport& report, bool dry_run) {
    std::string out;
    for (const BatchPicture& picture : report.pictures)
        if (picture.state == State::failed) out += fmt::format("failed       {}\n", picture.input);
    out += fmt::format("{:<12} {:>6}\nup to date   {:>6}\nfailed       {:>6}\n", dry_run ? "to be drawn" : "drawn",
                       report.count(State::done), report.count(State::up_to_date), report.count(State::failed));
    const std::size_t not_reached = report.count(State::not_reached);
    return not_reached > 0 ? out + fmt::format("not reached  {:>6}\n", not_reached) : out;
}

std::pair<BatchReport, double> run_folder(const BatchRequest& batch, const Arguments& arguments, Interrupt& interrupt,
                                          const std::function<void(const BatchPicture&)>& tell) {
    Progress progress(!arguments.quiet && ::isatty(STDERR_FILENO) == 1);
    Work work;
    work.stop = interrupt.token();
    work.threads = arguments.threads;
    VerboseFolder verbose(batch);
    BatchReport report = run_batch(
        batch,
        [&](const BatchProgress& now) {
            interrupt.set_writing(now.writing);
            if (arguments.verbose) verbose.hear(now);
            if (now.at_work) return;
            progress.begin(fmt::format("{} of {} pictures", now.finished, now.total),
                           double(now.finished) / double(std::max<std::size_t>(1, now.total)));
            if (!now.picture) return;
            if (now.picture->state == State::failed)
                progress.beside([&] {
                    print_error({ErrorCode::failed, (batch.input / now.picture->input).string(), now.picture->problem,
                                 now.picture->remedy});
                });
            if (arguments.verbose) progress.beside([&] { std::fputs(verbose.said(now).c_str(), stderr); });
            if (tell) progress.beside([&] { tell(*now.picture); });
        },
        work);
    progress.finish();
    return {std::move(report), progress.seconds()};
}

ExitCode draw_folder(const Arguments& arguments) {
    const std::vector<BatchRequest> requests = folder_requests(arguments);
    Interrupt interrupt;
    ExitCode code = kDone;
    std::vector<BatchReport> reports;
    for (const BatchRequest& batch : requests) {
        reports.push_back(draw_batch(batch, arguments, interrupt));
        if (reports.back().count(State::failed) > 0) code = kSomeFailed;
    }
    if (arguments.json) print(batch_report_json(reports));
    return code;
}

}  // namespace dstylize::app
