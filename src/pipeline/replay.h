#pragma once
#include <filesystem>

#include "pipeline/run.h"

namespace dstylize {

/// What a replay is made of.
struct Replay {
    RunRequest request;        ///< without outputs
    std::string input_xxh128;  ///< of the picture that the recipe was made with
    bool on_paper = false;     ///< it was made with none
};

/// The run that made `old`, an output or a recipe file, again on `input`. Auxiliary files are looked for
/// where the recipe says, then beside `old`, then beside `input`, and must have the content that it names.
/// Throws Error(cannot_read) when `old` has no recipe or an auxiliary file is missing.
Replay replay_of(const std::filesystem::path& old, const std::filesystem::path& input, PictureCodec& codec,
                 std::uint64_t max_memory_bytes);

}  // namespace dstylize
