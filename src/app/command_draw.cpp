#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/report.h"
#include "app/requests.h"
#include "pipeline/replay.h"

namespace dstylize::app {

void refuse_folder(const std::filesystem::path& input) {
    std::error_code ignored;
    if (std::filesystem::is_directory(input, ignored))
        throw Error(ErrorCode::bad_usage, input.string(), "is a folder", "give one picture");
}

RunReport run_and_report(const RunRequest& request, const Arguments& arguments, PictureCodec& codec,
                         Interrupt& interrupt) {
    check_standard_output(request, arguments);
    if (arguments.styles.size() > 1)
        throw Error(ErrorCode::bad_usage, "--style " + arguments.styles[1], "is one style too many for one picture",
                    "give one; several are for folders");
    Progress progress(!arguments.quiet && ::isatty(STDERR_FILENO) == 1);
    Work work;
    work.stop = interrupt.token();
    work.threads = arguments.threads;
    work.progress = [&](std::string_view step, double share_done) {
        interrupt.set_writing(step == "writing");
        progress.begin(step, share_done);
    };
    RunReport report = run(request, codec, work);
    progress.finish();
    if (arguments.verbose) std::fputs(verbose_report(report, progress).c_str(), stderr);
    if (arguments.json)
        print(json_report(report, progress));
    else if (request.dry_run)
        print(dry_run_report(report));
    return report;
}

ExitCode draw(const Arguments& arguments) {
    std::error_code ignored;
    if (!arguments.names.empty() && std::filesystem::is_directory(arguments.names[0], ignored))
        return arguments.watch ? watch_folder(arguments) : draw_folder(arguments);
    const RunRequest request = draw_request(arguments);
    const auto refuse_option = [&](bool given, const char* option) {
        if (given)
            throw Error(ErrorCode::bad_usage, request.input.string(),
                        fmt::format("is no folder, and {} is for folders", option), "leave it out");
    };
    refuse_option(!arguments.patterns.empty(), "--include");
    refuse_option(arguments.name != Arguments().name, "--name");
    refuse_option(!arguments.manifest.empty(), "--manifest");
    refuse_option(!arguments.shard.empty(), "--shard");
    refuse_option(arguments.watch, "--watch");
    Interrupt interrupt;
    PictureCodec codec(codec_options(arguments));  // loads while the style is read
    run_and_report(request, arguments, codec, interrupt);
    return kDone;
}

void replay(const Arguments& arguments) {
    if (arguments.names.size() < 2 || arguments.names.size() > 3)
        throw Error(ErrorCode::bad_usage, "replay", "wants a drawing, a picture and an output",
                    "write dstylize replay OLD IN OUT");
    const std::filesystem::path old = arguments.names[0], input = arguments.names[1];
    refuse_folder(old);
    refuse_folder(input);
    Interrupt interrupt;
    PictureCodec codec(codec_options(arguments));
    Replay made = replay_of(old, input, codec, arguments.max_memory);
    RunRequest& request = made.request;
    // What was written on paper can be made again on paper, with no picture between OLD and OUT.
    const bool on_paper = made.on_paper && arguments.names.size() == 2 && arguments.outputs.empty();
    if (on_paper) request.input.clear();
    const std::size_t named = on_paper ? 1 : 2;
    if (arguments.names.size() > named) request.outputs.emplace_back(arguments.names[named]);
    set_output_options(request, arguments);
    const RunReport report = run_and_report(request, arguments, codec, interrupt);
    if (!arguments.quiet && !made.on_paper && report.input_xxh128 != made.input_xxh128)
        std::fputs(fmt::format("dstylize: {}: is not the picture that {} was made from: drawn all the same\n",
                               report.input, old.string())
                       .c_str(),
                   stderr);
}

}  // namespace dstylize::app
