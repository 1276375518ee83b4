#include "pipeline/settled_files.h"

namespace dstylize {
namespace {

namespace fs = std::filesystem;
constexpr int kLooksUnchanged = 2;

}  // namespace

FileStates file_states(const fs::path& folder, const std::vector<fs::path>& files) {
    FileStates out;
    for (const fs::path& file : files) {
        std::error_code gone;
        const std::uintmax_t bytes = fs::file_size(folder / file, gone);
        if (gone) continue;
        const fs::file_time_type written = fs::last_write_time(folder / file, gone);
        if (!gone) out.emplace(file, FileState{bytes, written});
    }
    return out;
}

std::set<fs::path> SettledFiles::after_look(const FileStates& now) {
    std::erase_if(seen_, [&](const auto& seen) { return !now.contains(seen.first); });
    std::set<fs::path> settled;
    for (const auto& [file, state] : now) {
        const auto [at, is_new] = seen_.try_emplace(file, Seen{state, 0});
        Seen& seen = at->second;
        if (is_new) continue;
        if (seen.state != state)
            seen = {state, 0};
        else if (seen.looks_unchanged < kLooksUnchanged && ++seen.looks_unchanged == kLooksUnchanged && state.bytes > 0)
            settled.insert(file);
    }
    return settled;
}

}  // namespace dstylize
