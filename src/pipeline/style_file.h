#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/style.h"

namespace dstylize {

/// A style that comes with the program.
struct BuiltinStyle {
    std::string_view name, toml;
};
/// In the order of their names.
const std::vector<BuiltinStyle>& builtin_styles();

/// One `--set key=value`: "section.key" or "stage.NAME.key"; `value` is TOML, or a bare word as text.
struct Setting {
    std::string key, value;
};

/// A style by name, built in or NAME.toml in the user's folder (which may be empty: none), or a style file
/// by path (anything with a slash or ending in .toml), with the settings applied. Throws Error(bad_usage) with line and
/// column for unknown keys (naming the nearest), wrong types and values out of range.
Style load_style(const std::string& name_or_file, const std::vector<Setting>& settings = {},
                 const std::filesystem::path& user_folder = {});

/// The same from text; `origin` names it in errors.
Style parse_style(std::string_view toml, const std::string& origin, const std::vector<Setting>& settings = {},
                  const std::filesystem::path& user_folder = {});

/// The names of the style files in the user's folder, sorted.
std::vector<std::string> user_style_names(const std::filesystem::path& user_folder);

/// The text of a style as it was written, comments and all: what `styles --copy` copies.
std::string style_source(const std::string& name_or_file, const std::filesystem::path& user_folder = {});

/// Every parameter, in canonical order: a style file that makes the same drawing.
std::string style_toml(Style& style);

/// The table that `dstylize styles NAME` prints: key, value, range, unit, meaning.
std::string style_description(Style& style);

/// The candidate with the smallest edit distance to `word`, or "" when none is near.
std::string nearest_name(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace dstylize
