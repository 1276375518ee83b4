#pragma once
#include <CLI/CLI.hpp>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "core/error.h"

namespace dstylize::app {

/// What the options say, as text where the library parses it.
struct Arguments {
    std::vector<std::string> names;  ///< IN and OUT, or OLD, IN and OUT
    std::vector<std::string> styles, outputs, settings, roots, patterns, formats;
    std::string importance, importance_mode, mask, endpoints, background, place, blend, show;
    std::string size, recipe_file;
    double scale = 0;
    int detail = 0, threads = 0, quality = 92, compression = 1;
    std::int64_t seed = 1;
    std::uint64_t max_memory = 4ull << 30;
    bool force = false, dry_run = false, no_recipe = false, allow_damaged = false;
    bool quiet = false, verbose = false, json = false;
    bool help = false, help_all = false, version = false;
    bool fields = false, copy = false;  ///< of `styles`
    // Of folders.
    std::string name = "{stem}", manifest, shard;
    bool watch = false;
    // Of `sbatch`.
    int nodes = 0, shards = 0;
    std::vector<std::string> slurm;
    bool submit = false;
    // Of `write`.
    std::string font, align;
    float letter_spacing = 0.04f, line_spacing = 1, text_size = 0;
};

/// The parser of one form of the command line, which fills in `arguments` (they must live as long).
class Parser {
  public:
    enum class Form { draw, write, replay, styles, sbatch, merge };
    Parser(Form form, Arguments& arguments);

    /// Throws Error(bad_usage).
    void parse(std::vector<std::string> words);
    /// The text of --help, or with every option that of --help-all.
    std::string help(bool all);
    /// The options that were given, as words of a command line, without those of these names.
    std::vector<std::string> given_options(const std::set<std::string>& but) const;

  private:
    CLI::Option* add(CLI::Option* option, const char* group, bool common = true);
    void add_drawing_options();
    void add_list_options();
    void add_merge_options();
    void add_style_options();
    void add_hand_options();
    void add_text_options();
    void add_output_options();
    void add_folder_options();
    void add_slurm_options();
    void add_run_options();
    void add_help_options();

    Form form_;
    Arguments& arguments_;
    CLI::App app_;
    std::vector<CLI::Option*> rare_;
};

/// That the words of the command line ask for something that cannot be.
Error usage_error(const std::string& what, const std::string& problem, const std::string& remedy);

}  // namespace dstylize::app
