#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "formats/format.h"

namespace dstylize {

/// One file to be written.
struct PlannedOutput {
    std::filesystem::path path;  ///< "-": standard output
    const OutputFormat* format = nullptr;
    bool replaces = false;  ///< a file of that name exists
    std::string name() const { return path == "-" ? "standard output" : path.string(); }
};

/// Finds each output's format (its extension's, or `format_name`) and whether it can be written, before
/// anything is computed: its folder exists and may be written to, it is none of `inputs`, and a file that
/// exists is ours or `force` is given. Throws Error(bad_usage) or Error(cannot_write).
std::vector<PlannedOutput> planned_outputs(const std::vector<std::filesystem::path>& paths,
                                           const std::string& format_name,
                                           std::span<const std::filesystem::path> inputs, bool force);

/// The same checks for a file that has no format of ours.
void check_target(const std::filesystem::path& path, std::span<const std::filesystem::path> inputs, bool force);

/// Throws Error(cannot_write) when a link would lead a file, which is to lie in the folder, out of it.
void check_inside(const std::filesystem::path& folder, const std::filesystem::path& target);

/// Writes the source of a style to a file, to start one's own from. Throws as check_target does.
void copy_style_file(const std::string& name_or_file, const std::filesystem::path& user_folder,
                     const std::filesystem::path& target, bool force);

/// Whether dstylize made the file, judged cheaply: its name stands in the first or the last megabyte, where
/// every format of ours keeps its metadata.
bool is_ours(const std::filesystem::path& path);

}  // namespace dstylize
