#pragma once
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "formats/picture_codec.h"
#include "pipeline/manifest.h"
#include "pipeline/run.h"
#include "pipeline/shard.h"

namespace dstylize {

/// A folder of pictures, drawn one way, into a folder of the same shape.
struct BatchRequest {
    /// What all pictures share. `input`, `outputs` and `format` are not looked at; a picture's own seed is made of
    /// `seed` and its path from the folder, so that adding a picture changes no other.
    RunRequest each;
    std::filesystem::path input, output;  ///< folders; `output` is made if need be
    std::filesystem::path leave_out;      ///< a folder of results in `input`; empty: `output`
    std::vector<std::string> patterns;    ///< as pictures_in takes them
    std::vector<std::string> formats;     ///< every drawing is written in each of them; empty: png
    std::string name = "{stem}";          ///< as ResultNaming::name
    std::filesystem::path manifest;       ///< says which pictures, and is made if need be; empty: those in the folder
    std::optional<Shard> shard;           ///< draw only this share of them
    std::optional<std::set<std::filesystem::path>> only;  ///< draw only these of them
    CodecOptions codec;
};

struct BatchPicture {
    enum class State { done, up_to_date, failed, not_reached };
    std::string input;                 ///< path from the input folder
    std::vector<std::string> results;  ///< paths from the output folder
    State state = State::not_reached;
    std::string problem, remedy;  ///< of what failed
};

struct BatchReport {
    std::string style;
    std::vector<BatchPicture> pictures;  ///< in the order of their paths
    std::size_t all = 0;                 ///< pictures of the folder or the manifest, of which these are some or all
    std::string key;                     ///< hash of everything that shapes the results, but for the pictures
    std::string manifest_xxh128;         ///< of the manifest's content; empty where there is none
    std::size_t count(BatchPicture::State state) const;
};

/// What a batch tells while it runs, from any thread, one call at a time.
struct BatchProgress {
    std::size_t finished = 0, total = 0;
    bool writing = false;                   ///< whether some file is just being written
    const BatchPicture* picture = nullptr;  ///< that has just been finished
    const RunReport* drawn = nullptr;       ///< how, if it has been drawn
    const BatchPicture* at_work = nullptr;  ///< one that is about to do `step`
    std::string_view step;                  ///< of run(), or "thumbnails"; empty when it fails
};

/// Checks what can be checked of a batch before a picture is read, and makes its manifest. Throws as run_batch does.
Manifest batch_pictures(const BatchRequest& request);

/// Draws all pictures that are not up to date: whose results are there, as long as they were made, from the same
/// content, in the same way, by the same version. Goes on past pictures that fail, among them those whose results would
/// lie behind a link or have become files of others. As many are drawn at a time as there are threads and gibibytes of
/// `each.max_memory_bytes`; each may need its share of them, and those that need more are drawn alone afterwards. The
/// bytes of a result depend on none of this, nor on what is drawn elsewhere. A shard keeps a ledger of its own, so that
/// several can run on one folder of results at a time. In a dry run nothing is written, and pictures that would be
/// drawn are `done`. When it is asked to stop, pictures that it is at are given up, and are `not_reached` as those
/// after them. Throws Error(bad_usage) for folders that cannot be these, and for what is wrong with every picture: a
/// style, an auxiliary file; Error(cannot_read) for a manifest; Error(cannot_write).
BatchReport run_batch(const BatchRequest& request, const std::function<void(const BatchProgress&)>& observer,
                      const Work& work);

}  // namespace dstylize
