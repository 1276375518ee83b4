#pragma once
#include <cstdint>
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

/// Throws Error(bad_usage) for a name that has no {stem}, an unknown field, or a way out of the folder.
void check_naming(const ResultNaming& naming);

/// The names of results, as paths from the output folder, of pictures that are given as paths from the input folder.
/// Pictures whose results would share a name, with each other or with the batch's own report, keep their extensions
/// inside it: a.jpg and a.png become a.jpg.png and a.png.png.
class ResultNames {
  public:
    /// Throws as check_naming does.
    ResultNames(ResultNaming naming, const std::vector<std::string>& all_pictures);

    /// One of the pictures' results.
    std::vector<std::string> of(const std::string& picture) const;

  private:
    ResultNaming naming_;
    std::vector<std::string> shared_;  ///< names that several results would have, in order
};

}  // namespace dstylize
