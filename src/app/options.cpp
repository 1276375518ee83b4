// The command line as CLI11 options, in groups; rare ones appear in --help-all only. completions/ and
// docs/dstylize.1 repeat this list by hand, and a contract test compares them.
#include "app/options.h"

#include <algorithm>
#include <filesystem>
#include <limits>

#include "pipeline/style_file.h"
#include "pipeline/writing.h"

namespace dstylize::app {
namespace {

constexpr const char* kStyle = "Style";
constexpr const char* kText = "Words";
constexpr const char* kHand = "By hand";
constexpr const char* kOutput = "Output";
constexpr const char* kFolder = "Folders";
constexpr const char* kSlurm = "Slurm";
constexpr const char* kRun = "Run";
constexpr int kHelpColumn = 30;
/// What the codec needs before it has seen a picture, and a little more.
constexpr std::uint64_t kLeastMemory = 256u << 20;

class HelpFormatter final : public CLI::Formatter {
  public:
    explicit HelpFormatter(std::string usage) : usage_(std::move(usage)) { column_width(kHelpColumn); }
    std::string make_usage(const CLI::App*, std::string) const override { return usage_; }
    std::string make_description(const CLI::App*) const override { return ""; }
    std::string make_positionals(const CLI::App*) const override { return ""; }
    std::string make_option_opts(const CLI::Option* option) const override {
        return option->get_type_size() == 0 ? "" : " " + option->get_type_name();
    }

  private:
    std::string usage_;
};

const char* usage(Parser::Form form) {
    switch (form) {
        case Parser::Form::draw:
            return "dstylize IN OUT [options]       redraw a picture, or a folder of pictures\n"
                   "dstylize write TEXT [IN] OUT    write words with branches, on paper or a picture\n"
                   "dstylize replay OLD IN OUT      make the drawing OLD again, say at another size\n"
                   "dstylize styles [NAME]          list the styles, or one with all its parameters\n";
        case Parser::Form::write:
            return "dstylize write TEXT OUT [options]              words on paper\n"
                   "dstylize write TEXT IN OUT [options]           words on the picture IN\n"
                   "dstylize write --mask FILE [IN] OUT [options]  shapes that are white in FILE\n"
                   "Grows a dendrite in every part of the letters. In TEXT, \\n begins a new line.\n";
        case Parser::Form::replay:
            return "dstylize replay OLD IN OUT [options]\n"
                   "Makes the drawing OLD (or a --recipe file) again from the picture IN.\n";
        case Parser::Form::sbatch:
            return "dstylize sbatch IN OUT --nodes N [options]\n"
                   "Writes a Slurm job array that draws the folder IN into the folder OUT, and a\n"
                   "job that merges the reports. Takes every option of a drawing.\n";
        case Parser::Form::merge:
            return "dstylize merge-reports OUT...\n"
                   "Makes of the reports of all shards that of the whole run.\n";
        case Parser::Form::styles:
            return "dstylize styles [NAME|FILE] [--fields]\n"
                   "dstylize styles --copy NAME FILE\n"
                   "Lists the styles, or one with every parameter, its range and its value.\n";
    }
    return "";
}

/// Forms that are named where there is room.
constexpr const char* kFurtherForms =
    "dstylize sbatch IN OUT          draw a folder on many machines, with Slurm\n"
    "dstylize merge-reports OUT      make one report of those of all shards\n";

}  // namespace

Error usage_error(const std::string& what, const std::string& problem, const std::string& remedy) {
    return Error(ErrorCode::bad_usage, what, problem, remedy);
}

Parser::Parser(Form form, Arguments& arguments) : form_(form), arguments_(arguments) {
    app_.formatter(std::make_shared<HelpFormatter>(usage(form)));
    app_.set_help_flag();
    app_.allow_extras();
    app_.add_option("names", arguments_.names);
    if (form == Form::styles)
        add_list_options();
    else if (form == Form::merge)
        add_merge_options();
    else
        add_drawing_options();
    add_help_options();
}

void Parser::add_drawing_options() {
    if (form_ == Form::write) add_text_options();
    if (form_ == Form::sbatch) add_slurm_options();
    if (form_ != Form::replay) {
        add_style_options();
        add_hand_options();
    }
    add_output_options();
    if (form_ == Form::draw || form_ == Form::sbatch) add_folder_options();
    add_run_options();
}

void Parser::add_list_options() {
    add(app_.add_flag("--fields", arguments_.fields, "list the fields that styles and --show name"), kStyle);
    add(app_.add_flag("--copy", arguments_.copy, "copy the style NAME to FILE, to change it there"), kStyle);
    add(app_.add_flag("-f,--force", arguments_.force, "replace FILE"), kStyle);
}

void Parser::add_merge_options() {
    add(app_.add_flag("--json", arguments_.json, "the report as JSON on standard output"), kRun);
    add(app_.add_flag("-q,--quiet", arguments_.quiet, "no summary"), kRun);
}

CLI::Option* Parser::add(CLI::Option* option, const char* group, bool common) {
    option->group(group);
    if (!common) rare_.push_back(option);
    return option;
}

void Parser::add_style_options() {
    Arguments& a = arguments_;
    add(app_.add_option("-s,--style", a.styles, "vine, ink, …, or a .toml file; default vine"), kStyle)
        ->type_name("NAME")
        ->allow_extra_args(false);
    add(app_.add_option("--set", a.settings, "change a parameter, as stage.tone.carry=0.6"), kStyle)
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    add(app_.add_option("--detail", a.detail, "lattice nodes on the long side, 16 to 16384"), kStyle)
        ->type_name("N")
        ->check(CLI::Range(16, 16384).description(""));
    add(app_.add_option("--seed", a.seed, "of all randomness; default 1"), kStyle)
        ->type_name("N")
        ->check(CLI::Range(std::int64_t(0), std::numeric_limits<std::int64_t>::max()).description(""));
}

void Parser::add_text_options() {
    Arguments& a = arguments_;
    add(app_.add_option("--font", a.font, "any installed font; default DejaVu Sans Bold"), kText)->type_name("NAME");
    add(app_.add_option("--text-size", a.text_size, "font size, of the picture's height; default: fits"), kText)
        ->type_name("X")
        ->check(CLI::Range(0.01f, Writing::kMostSize).description(""));
    add(app_.add_option("--align", a.align, "of several lines: left, centre or right"), kText)
        ->type_name("SIDE")
        ->check(CLI::IsMember({"left", "centre", "right"}).description(""));
    add(app_.add_option("--letter-spacing", a.letter_spacing, "added between letters, in em; default 0.04"), kText)
        ->type_name("X")
        ->check(CLI::Range(Writing::kLeastSpacing, Writing::kMostSpacing).description(""));
    add(app_.add_option("--line-spacing", a.line_spacing, "1: the font's own"), kText)
        ->type_name("X")
        ->check(CLI::Range(Writing::kLeastLines, Writing::kMostLines).description(""));
}

void Parser::add_hand_options() {
    Arguments& a = arguments_;
    add(app_.add_option("--root", a.roots, "where it grows from: x,y or bottom … darkest"), kHand)
        ->type_name("PLACE")
        ->allow_extra_args(false);
    add(app_.add_option("--mask", a.mask, "grow only where this picture is white"), kHand)->type_name("FILE");
    add(app_.add_option("--importance", a.importance, "multiply by this picture; none: use no picture"), kHand)
        ->type_name("FILE");
    add(app_.add_option("--importance-mode", a.importance_mode, "multiply (default) or replace"), kHand, false)
        ->type_name("MODE")
        ->check(CLI::IsMember({"multiply", "replace"}).description(""));
    add(app_.add_option("--endpoints", a.endpoints, "paths must arrive here: lines of x,y[,STAGE]"), kHand, false)
        ->type_name("FILE");
    add(app_.add_option("--background", a.background, "input, none, #rrggbb or a picture"), kHand)->type_name("WHAT");
    const bool words = form_ == Form::write;
    add(app_.add_option("--place", a.place,
                        words ? "the words' middle x,y, or as without words" : "stand there in the background"),
        kHand, words)
        ->type_name(words ? "X,Y[,W,H]" : "X,Y,W,H");
    add(app_.add_option("--blend", a.blend, "over (default), multiply, screen or soft-light"), kHand, false)
        ->type_name("MODE");
    add(app_.add_option("--show", a.show, "write importance, weights, tree, … instead"), kHand)->type_name("STAGE");
}

void Parser::add_output_options() {
    Arguments& a = arguments_;
    CLI::Option* size = add(app_.add_option("--size", a.size, "2400, 150%, 30cm@300dpi or A3"), kOutput);
    size->type_name("SIZE");
    add(app_.add_option("--scale", a.scale, "output pixels for each of the input's"), kOutput, false)
        ->type_name("X")
        ->check(CLI::Range(1e-3, 1e3).description(""))
        ->excludes(size);
    add(app_.add_option("-o,--output", a.outputs, "one more output: png jpg tif webp svg pdf json"), kOutput)
        ->type_name("FILE")
        ->allow_extra_args(false);
    add(app_.add_option("--format", a.formats, "of outputs without extension; of folders several"), kOutput, false)
        ->type_name("FORMAT")
        ->allow_extra_args(false);
    add(app_.add_option("--quality", a.quality, "jpg, webp: 1 to 100; default 92"), kOutput, false)
        ->type_name("N")
        ->check(CLI::Range(1, 100).description(""));
    add(app_.add_option("--compression", a.compression, "png, tif: 0 to 9, slow above the default 1"), kOutput, false)
        ->type_name("N")
        ->check(CLI::Range(0, 9).description(""));
    add(app_.add_option("--recipe", a.recipe_file, "write the recipe as a style file, too"), kOutput, false)
        ->type_name("FILE");
    add(app_.add_flag("--no-recipe", a.no_recipe, "leave the recipe out of the outputs"), kOutput, false);
    add(app_.add_flag("-f,--force", a.force, "replace files that dstylize did not make"), kOutput);
    add(app_.add_flag("--dry-run", a.dry_run, "check everything, say what would be done"), kOutput);
}

void Parser::add_folder_options() {
    Arguments& a = arguments_;
    add(app_.add_option("--include", a.patterns, "only these pictures, as '*.jpg'"), kFolder, false)
        ->type_name("PATTERN")
        ->allow_extra_args(false);
    add(app_.add_option("--name", a.name, "of drawings: default {stem}; {style}, {seed}"), kFolder, false)
        ->type_name("TEMPLATE");
    add(app_.add_option("--manifest", a.manifest, "list of the pictures; made where it is missing"), kFolder, false)
        ->type_name("FILE");
    if (form_ != Form::draw) return;
    CLI::Option* shard =
        add(app_.add_option("--shard", a.shard, "draw only every N-th of the manifest"), kFolder, false);
    shard->type_name("K/N");
    add(app_.add_flag("--watch", a.watch, "draw what comes into the folder, until interrupted"), kFolder, false)
        ->excludes(shard);
}

void Parser::add_slurm_options() {
    Arguments& a = arguments_;
    add(app_.add_option("--nodes", a.nodes, "machines to use at a time"), kSlurm)
        ->type_name("N")
        ->check(CLI::Range(1, 100000).description(""));
    add(app_.add_option("--shards", a.shards, "parts of the work; default: 4 for each node"), kSlurm)
        ->type_name("N")
        ->check(CLI::Range(1, 1000000).description(""));
    add(app_.add_option("--slurm", a.slurm, "an option for sbatch, as --slurm=--partition=cpu"), kSlurm)
        ->type_name("OPTION")
        ->allow_extra_args(false);
    add(app_.add_flag("--submit", a.submit, "submit both, too"), kSlurm);
}

void Parser::add_run_options() {
    Arguments& a = arguments_;
    CLI::Option* quiet = add(app_.add_flag("-q,--quiet", a.quiet, "no progress on the terminal"), kRun, false);
    add(app_.add_flag("-v,--verbose", a.verbose, "times and counts of every step"), kRun)->excludes(quiet);
    add(app_.add_flag("--json", a.json, "one report as JSON on standard output"), kRun, false);
    add(app_.add_option("--threads", a.threads, "default: as many as the machine has"), kRun, false)
        ->type_name("N")
        ->check(CLI::Range(0, 1024).description(""));
    add(app_.add_option("--max-memory", a.max_memory, "refuse what needs more; default 4G"), kRun, false)
        ->type_name("SIZE")
        ->transform(CLI::AsSizeValue(false).description(""));
    add(app_.add_flag("--allow-damaged", a.allow_damaged, "take what can be read of a damaged picture"), kRun, false);
}

void Parser::add_help_options() {
    const char* group = form_ == Form::styles ? kStyle : kRun;
    add(app_.add_flag("-h,--help", arguments_.help, "this page"), group, form_ != Form::draw);
    if (form_ != Form::draw) return;
    add(app_.add_flag("--help-all", arguments_.help_all, "every option; see also man dstylize"), group);
    add(app_.add_flag("--version", arguments_.version, "name the version"), group, false);
}

void Parser::parse(std::vector<std::string> words) {
    std::reverse(words.begin(), words.end());  // CLI11 takes them from the back
    try {
        app_.parse(std::move(words));
    } catch (const CLI::ParseError& error) {
        throw usage_error("", error.what(), "see dstylize --help");
    }
    if (arguments_.max_memory < kLeastMemory)
        throw usage_error("--max-memory", "is less than reading any picture takes", "give at least 256M");
    std::vector<std::string> known;
    for (const CLI::Option* option : app_.get_options())
        for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    for (const std::string& word : app_.remaining()) {
        if (word.size() < 2 || word[0] != '-') continue;
        const std::string near = word.starts_with("--") ? nearest_name(word.substr(0, word.find('=')), known) : "";
        throw usage_error(word, "unknown option",
                          near.empty() ? "see dstylize --help-all" : "did you mean '" + near + "'?");
    }
}

std::string Parser::help(bool all) {
    std::vector<std::string> groups;
    for (CLI::Option* option : rare_) {
        groups.push_back(option->get_group());
        if (!all) option->group("");
    }
    std::string text = app_.help();
    if (all && form_ == Form::draw) text.insert(text.find("\n\n") + 1, kFurtherForms);
    // CLI11 puts two empty lines between groups: the page would not fit a screen.
    for (std::size_t at; (at = text.find("\n\n\n")) != std::string::npos;) text.erase(at, 1);
    text.erase(text.find_last_not_of('\n') + 2);
    for (std::size_t i = 0; i < rare_.size(); ++i) rare_[i]->group(groups[i]);
    return text;
}

std::vector<std::string> Parser::given_options(const std::set<std::string>& but) const {
    std::vector<std::string> words;
    for (const CLI::Option* option : app_.get_options()) {
        if (option->count() == 0 || option->get_lnames().empty() || but.contains(option->get_lnames().front()))
            continue;
        const std::string name = "--" + option->get_lnames().front();
        if (option->get_type_size() == 0)
            words.push_back(name);
        else
            for (const std::string& value : option->results()) words.push_back(name + "=" + value);
    }
    return words;
}

}  // namespace dstylize::app
