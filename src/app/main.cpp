#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <map>
#include <new>
#include <system_error>

#include "app/commands.h"
#include "app/report.h"
#include "pipeline/version.h"

namespace dstylize::app {

ExitCode exit_code(ErrorCode code) {
    switch (code) {
        case ErrorCode::failed: return kFailed;
        case ErrorCode::bad_usage: return kWrongUsage;
        case ErrorCode::cannot_read: return kInputUnreadable;
        case ErrorCode::cannot_write: return kOutputUnwritable;
        case ErrorCode::cancelled: return kInterrupted;
    }
    return kFailed;
}

void print(const std::string& text) {
    if (std::fputs(text.c_str(), stdout) < 0 || std::fflush(stdout) != 0)
        throw Error(ErrorCode::cannot_write, "standard output",
                    fmt::format("cannot be written ({})", std::strerror(errno)), "check where it goes");
}

void print_error(const Error& error) {
    std::string line = fmt::format("dstylize: {}", error.what());
    for (char& c : line)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
    std::fputs((line + "\n").c_str(), stderr);
}

namespace {

int fail(const Error& error, const Arguments& arguments) {
    print_error(error);
    const ExitCode code = exit_code(error.code());
    try {
        if (arguments.json) print(json_report(error, code));
    } catch (const Error&) {
        // The first error is the one that counts.
    }
    return code;
}

ExitCode run_form(Parser::Form form, std::vector<std::string> words, Arguments& arguments) {
    Parser parser(form, arguments);
    parser.parse(std::move(words));
    if (arguments.version) {
        print(fmt::format("dstylize {}\n", version()));
        return kDone;
    }
    if (arguments.help || arguments.help_all) {
        print(parser.help(arguments.help_all || form != Parser::Form::draw));
        return kDone;
    }
    switch (form) {
        case Parser::Form::draw: return draw(arguments);
        case Parser::Form::write: write(arguments); break;
        case Parser::Form::replay: replay(arguments); break;
        case Parser::Form::styles: list_styles(arguments); break;
        case Parser::Form::sbatch: write_slurm_jobs(arguments, parser); break;
        case Parser::Form::merge: return merge_reports(arguments);
    }
    return kDone;
}

int run_program(std::vector<std::string> words) {
    static const std::map<std::string, Parser::Form> kVerbs{{"styles", Parser::Form::styles},
                                                            {"write", Parser::Form::write},
                                                            {"replay", Parser::Form::replay},
                                                            {"sbatch", Parser::Form::sbatch},
                                                            {"merge-reports", Parser::Form::merge}};
    Parser::Form form = Parser::Form::draw;
    if (const auto verb = words.empty() ? kVerbs.end() : kVerbs.find(words[0]); verb != kVerbs.end()) {
        form = verb->second;
        words.erase(words.begin());
    }
    Arguments arguments;
    try {
        return run_form(form, std::move(words), arguments);
    } catch (const Error& error) {
        return fail(error, arguments);
    } catch (const std::bad_alloc&) {
        return fail({ErrorCode::failed, "", "out of memory", "ask for less --detail or a smaller --size"}, arguments);
    } catch (const std::system_error& error) {  // a thread, say
        return fail({ErrorCode::failed, "", fmt::format("the system refused ({})", error.what()),
                     "free memory or close programs"},
                    arguments);
    } catch (const std::exception& error) {
        return fail({ErrorCode::failed, "", error.what(), "please report this"}, arguments);
    }
}

}  // namespace
}  // namespace dstylize::app

int main(int argc, char** argv) {
    try {
        return dstylize::app::run_program({argv + 1, argv + argc});
    } catch (const std::bad_alloc&) {  // none even for the words or for the report of another error
        std::fputs("dstylize: out of memory: close other programs, or raise the limit on memory\n", stderr);
        return dstylize::app::kFailed;
    }
}
