#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace dstylize {

/// How the results of a folder's pictures are named.
struct ResultNaming {
    /// The name without extension, in the picture's own folder: {stem} is the picture's name without extension, {style}
    /// and {seed} are the run's. A slash makes folders.
    std::string name = "{stem}";
    std::string style;
    std::uint64_t seed = 1;
    std::vector<std::string> extensions;  ///< of every picture's results, in this order
};

/// The results of each picture, as paths from the output folder. Pictures whose results would share a name, with each
/// other or with the batch's own report, keep their extensions inside it: a.jpg and a.png become a.jpg.png and
/// a.png.png. Throws Error(bad_usage) for a name that has no {stem}, an unknown field, or a way out of the folder.
std::vector<std::vector<std::filesystem::path>> result_names(const std::vector<std::filesystem::path>& pictures,
                                                             const ResultNaming& naming);

}  // namespace dstylize
