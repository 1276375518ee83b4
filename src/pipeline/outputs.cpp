#include "pipeline/outputs.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "core/error.h"
#include "formats/files.h"
#include "pipeline/style_file.h"

namespace dstylize {
namespace {

namespace fs = std::filesystem;

bool same_file(const fs::path& a, const fs::path& b) {
    std::error_code ignored;
    if (a == "-" || b == "-" || a.empty() || b.empty()) return false;
    return fs::equivalent(a, b, ignored) || fs::weakly_canonical(fs::absolute(a, ignored), ignored) ==
                                                fs::weakly_canonical(fs::absolute(b, ignored), ignored);
}

const OutputFormat& format_of(const fs::path& path, const std::string& format_name) {
    if (format_name.empty()) {
        if (path == "-")
            throw Error(ErrorCode::bad_usage, "standard output", "has no extension, so no format", "give --format");
        return format_for(path);
    }
    const OutputFormat& asked = format_named(format_name);
    const std::string extension = path.has_extension() ? path.extension().string().substr(1) : "";
    for (const OutputFormat& format : output_formats())
        if (format.id != asked.id &&
            std::find(format.extensions.begin(), format.extensions.end(), extension) != format.extensions.end())
            throw Error(ErrorCode::bad_usage, path.string(),
                        "its extension says " + std::string(format.name) + ", --format says " + std::string(asked.name),
                        "change one of them");
    return asked;
}

std::string chunk(std::ifstream& file, std::streamoff from, std::size_t size) {
    std::string bytes(size, '\0');
    file.clear();
    file.seekg(from);
    file.read(bytes.data(), std::streamsize(size));
    bytes.resize(std::size_t(std::max<std::streamsize>(0, file.gcount())));
    return bytes;
}

}  // namespace

bool is_ours(const fs::path& path) {
    constexpr std::size_t kChunk = 1 << 20;
    constexpr std::string_view kMark = "dstylize";
    std::error_code ignored;
    const std::uintmax_t size = fs::file_size(path, ignored);
    std::ifstream file(path, std::ios::binary);
    if (ignored || !file) return false;
    if (chunk(file, 0, kChunk).find(kMark) != std::string::npos) return true;
    return size > kChunk &&
           chunk(file, std::streamoff(std::max<std::uintmax_t>(kChunk, size - kChunk)), kChunk).find(kMark) !=
               std::string::npos;
}

void check_inside(const fs::path& folder, const fs::path& target) {
    std::error_code error, ignored;
    const fs::path root = fs::canonical(folder, error), parent = fs::weakly_canonical(target.parent_path(), error);
    const bool inside = std::mismatch(root.begin(), root.end(), parent.begin(), parent.end()).first == root.end();
    if (error || !inside || fs::is_symlink(target, ignored))
        throw Error(ErrorCode::cannot_write, target.string(), "a link leads out of the folder of the drawings",
                    "remove the link");
}

void check_target(const fs::path& path, std::span<const fs::path> inputs, bool force) {
    if (path == "-") return;
    const std::string name = path.string();
    if (name.empty()) throw Error(ErrorCode::bad_usage, "", "an output has an empty name", "give a file name");
    std::error_code ignored;
    const fs::file_status status = fs::status(path, ignored);
    if (fs::is_directory(status) || name.back() == '/')
        throw Error(ErrorCode::bad_usage, name, "is a folder", "give a file name");
    for (const fs::path& input : inputs)
        if (same_file(path, input))
            throw Error(ErrorCode::bad_usage, name, "is also an input", "give another name for the output");
    if (!fs::exists(status)) {
        const fs::path folder = path.parent_path().empty() ? fs::path(".") : path.parent_path();
        if (!fs::is_directory(folder, ignored))
            throw Error(ErrorCode::cannot_write, name, "there is no folder " + folder.string(), "make it first");
        if (::access(folder.c_str(), W_OK | X_OK) != 0)
            throw Error(ErrorCode::cannot_write, name, "its folder may not be written to",
                        "change the folder's permissions or write elsewhere");
        return;
    }
    if (::access(path.c_str(), W_OK) != 0)
        throw Error(ErrorCode::cannot_write, name, "exists and may not be written to",
                    "change its permissions or give another name");
    if (!fs::is_regular_file(status) || force || fs::is_empty(path, ignored) || is_ours(path)) return;
    throw Error(ErrorCode::cannot_write, name, "exists and was not made by dstylize",
                "give another name, or --force to replace it");
}

std::vector<PlannedOutput> planned_outputs(const std::vector<fs::path>& paths, const std::string& format_name,
                                           std::span<const fs::path> inputs, bool force) {
    if (paths.empty()) throw Error(ErrorCode::bad_usage, "", "no output is named", "give OUT, or -o FILE");
    std::vector<PlannedOutput> out;
    for (const fs::path& path : paths) {
        PlannedOutput output{path, nullptr, false};
        check_target(path, inputs, force);
        output.format = &format_of(path, format_name);
        std::error_code ignored;
        output.replaces = path != "-" && fs::is_regular_file(path, ignored);
        for (const PlannedOutput& other : out)
            if (other.path == path || same_file(other.path, path))
                throw Error(ErrorCode::bad_usage, output.name(), "is named twice as an output",
                            "give each output a name of its own");
        out.push_back(std::move(output));
    }
    return out;
}

void copy_style_file(const std::string& name_or_file, const fs::path& user_folder, const fs::path& target, bool force) {
    const std::string source = style_source(name_or_file, user_folder);
    check_target(target, {}, force);
    write_file_atomically(target, std::as_bytes(std::span(source)));
}

}  // namespace dstylize
