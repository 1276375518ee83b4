#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <vector>

namespace dstylize {

/// What shows that a file is being written, or was written anew.
struct FileState {
    std::uintmax_t bytes = 0;
    std::filesystem::file_time_type written;
    friend bool operator==(const FileState&, const FileState&) = default;
};
using FileStates = std::map<std::filesystem::path, FileState>;

/// The states of files, which are named by their paths from the folder. Those that are gone are left out.
FileStates file_states(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& files);

/// Tells which files of a folder are whole, from looks at it some time apart: those with something in them that two
/// further looks found as they were. A file that was told is told again when it has changed and settled anew.
class SettledFiles {
  public:
    /// Those that this look shows to be settled, and the looks before it did not.
    std::set<std::filesystem::path> after_look(const FileStates& now);

  private:
    struct Seen {
        FileState state;
        int looks_unchanged = 0;
    };
    std::map<std::filesystem::path, Seen> seen_;
};

}  // namespace dstylize
