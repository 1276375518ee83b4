#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace dstylize {

/// Which pictures of a folder a run draws, in a file, so that machines that start at different times agree on it.
struct Manifest {
    std::vector<std::string> pictures;  ///< as paths from the folder, each once
    std::string xxh128;                 ///< of the file's content
};

/// The text of a manifest: a line that counts the pictures, then a line for each, in which \\ stands for a backslash
/// and \n for a new line.
std::string manifest_text(const std::vector<std::string>& pictures);
/// The same read. `name` is the file's for messages. Throws Error(cannot_read) when it is no manifest, is not whole, or
/// names a picture twice or one outside of the folder.
Manifest parsed_manifest(std::string_view text, const std::string& name);

/// What the file says; where there is none it is made of what `list` returns. Of several that make it at the same time
/// one wins, and all return what that one wrote. Throws as parsed_manifest does, Error(cannot_write), and what `list`
/// throws.
Manifest frozen_manifest(const std::filesystem::path& file, const std::function<std::vector<std::string>()>& list);

}  // namespace dstylize
