// Looks at a folder again and again, rather than being told by the system of what changes: that works on network file
// systems as well, and finds whole what others write in pieces.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>

#include "app/commands.h"
#include "app/requests.h"
#include "pipeline/batch_report.h"
#include "pipeline/folder_listing.h"
#include "pipeline/settled_files.h"

namespace dstylize::app {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds kPause{1};
constexpr int kShareOfLooking = 10;  // looks take at most this part of the time

void check_watch(const Arguments& arguments) {
    const auto refuse = [](bool given, const char* option) {
        if (given)
            throw Error(ErrorCode::bad_usage, option, "is for a run that ends, and --watch does not",
                        "leave one of them out");
    };
    refuse(arguments.dry_run, "--dry-run");
    refuse(arguments.json, "--json");
    refuse(!arguments.manifest.empty(), "--manifest");
}

void pause(Clock::duration time, const std::stop_token& stop) {
    std::mutex mutex;
    std::unique_lock lock(mutex);
    std::condition_variable_any().wait_for(lock, stop, time, [] { return false; });
}

/// One way of drawing what comes, and all that it has drawn.
class Watch {
  public:
    explicit Watch(BatchRequest request) : request_(std::move(request)) {}

    void draw(std::set<std::filesystem::path> pictures, const Arguments& arguments, Interrupt& interrupt) {
        request_.only = std::move(pictures);
        const auto tell = [&](const BatchPicture& picture) {
            if (picture.state == BatchPicture::State::done && !arguments.quiet)
                print(fmt::format("drawn        {}\n", picture.results.front()));
        };
        BatchReport now = run_folder(request_, arguments, interrupt, tell).first;
        for (BatchPicture& picture : now.pictures)
            if (picture.state != BatchPicture::State::not_reached)
                all_.insert_or_assign(picture.input, std::move(picture));
        if (all_.empty()) return interrupt.check();
        now.pictures.clear();
        for (const auto& [input, picture] : all_) now.pictures.push_back(picture);
        interrupt.set_writing(true);
        write_batch_reports(now, request_.input, request_.output);
        interrupt.set_writing(false);
        interrupt.check();
    }

  private:
    BatchRequest request_;
    std::map<std::string, BatchPicture> all_;
};

}  // namespace

ExitCode watch_folder(const Arguments& arguments) {
    check_watch(arguments);
    const std::vector<BatchRequest> requests = folder_requests(arguments);
    const BatchRequest& first = requests.front();
    Interrupt interrupt;
    std::vector<Watch> watches(requests.begin(), requests.end());
    for (Watch& watch : watches) watch.draw({}, arguments, interrupt);  // what is wrong with all is said at once
    if (!arguments.quiet) print(fmt::format("watching {}; an interrupt (Ctrl-C) ends it\n", first.input.string()));
    SettledFiles settled;
    std::string problem;
    while (true) {
        const Clock::time_point start = Clock::now();
        Clock::duration looking{};
        try {
            const std::vector<std::filesystem::path> pictures =
                pictures_in(first.input, first.patterns, first.leave_out.empty() ? first.output : first.leave_out);
            const std::set<std::filesystem::path> fresh = settled.after_look(file_states(first.input, pictures));
            looking = Clock::now() - start;
            if (!fresh.empty())
                for (Watch& watch : watches) watch.draw(fresh, arguments, interrupt);
            problem.clear();
        } catch (const Error& error) {
            // A folder that cannot be listed now, as that of a share that is away, may be there again.
            if (error.code() != ErrorCode::cannot_read) throw;
            if (problem != error.what()) print_error(error);
            problem = error.what();
        }
        pause(std::max<Clock::duration>(kPause, kShareOfLooking * looking), interrupt.token());
        interrupt.check();
    }
}

}  // namespace dstylize::app
