#pragma once
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "formats/picture_codec.h"
#include "pipeline/run.h"

namespace dstylize {

/// A folder of pictures, drawn one way, into a folder of the same shape. Results keep the pictures' names with the
/// extension of `each.format` ("png" when empty); pictures whose results would share a name keep their extensions
/// inside it: a.jpg and a.png become a.jpg.png and a.png.png.
struct BatchRequest {
    /// What all pictures share. `input` and `outputs` are not looked at; a picture's own seed is made of `seed` and its
    /// path from the folder, so that adding a picture changes no other.
    RunRequest each;
    std::filesystem::path input, output;  ///< folders; `output` is made if need be
    std::filesystem::path leave_out;      ///< a folder of results in `input`; empty: `output`
    std::vector<std::string> patterns;    ///< as pictures_in takes them
    CodecOptions codec;
};

struct BatchPicture {
    enum class State { done, up_to_date, failed };
    std::string input, result;  ///< paths from the two folders
    State state = State::failed;
    std::string problem, remedy;  ///< of what failed
};

struct BatchReport {
    std::string style;
    std::vector<BatchPicture> pictures;  ///< in the order of their paths
    std::size_t count(BatchPicture::State state) const;
};

/// What a batch tells while it runs, from any thread, one call at a time.
struct BatchProgress {
    std::size_t finished = 0, total = 0;
    bool writing = false;                   ///< whether some file is just being written
    const BatchPicture* picture = nullptr;  ///< that has just been finished
};

/// Draws all pictures that are not up to date: whose result is there as it was made, from the same content, in the
/// same way, by the same version. Goes on past pictures that fail, among them those whose result
/// would lie behind a link. As many are drawn at a time as there are threads
/// and gibibytes of `each.max_memory_bytes`; each may need its share of them, and those that need more are drawn alone
/// afterwards. The bytes of a result depend on none of this. Then writes report.json and index.html, a contact sheet,
/// into the output folder. In a dry run nothing is written, and pictures that would be drawn are `done`.
/// Throws Error(bad_usage) for folders that cannot be these, and for what is wrong with every picture: a style, an
/// auxiliary file; Error(cannot_write); Error(cancelled).
BatchReport run_batch(const BatchRequest& request, const std::function<void(const BatchProgress&)>& observer,
                      const Work& work);

}  // namespace dstylize
