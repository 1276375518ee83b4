#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/work.h"
#include "formats/picture_codec.h"
#include "pipeline/background.h"
#include "pipeline/controls.h"
#include "pipeline/output_size.h"
#include "pipeline/place.h"
#include "pipeline/style_file.h"
#include "pipeline/writing.h"

namespace dstylize {

/// A file beside the input. When `xxh128` is not empty the run refuses any other content.
struct AuxiliaryFile {
    std::filesystem::path path;
    std::string xxh128;
};

/// One picture's run as data: what the command line, a batch or a page asks for.
struct RunRequest {
    std::filesystem::path input;                 ///< "-": standard input; empty: plain paper, for a mask or words
    std::vector<std::filesystem::path> outputs;  ///< "-": standard output
    std::string format;                          ///< of outputs whose extension tells none

    std::string style = "vine";             ///< a built-in style or a file
    std::optional<std::string> style_toml;  ///< the style itself; `style` then names it in messages
    std::filesystem::path user_styles;      ///< folder of the user's own styles; empty: none
    std::vector<Setting> settings;
    int detail = 0;  ///< lattice nodes on the long side; 0: the style's
    std::uint64_t seed = 1;

    std::optional<Writing> writing;             ///< words that are the mask
    AuxiliaryFile importance, mask, endpoints;  ///< empty path: none
    bool importance_replaces = false;
    bool no_picture = false;  ///< grow without being led by the picture
    std::vector<RootChoice> roots;
    Background background;
    std::string background_xxh128;  ///< as in AuxiliaryFile, of background.file
    std::optional<Place> place;     ///< the output's frame is the background's, and the drawing stands here in it

    OutputSize size;
    std::string show;  ///< an intermediate to write in the drawing's place; empty: the drawing
    int quality = 92, compression = 1;

    int thumbnail_px = 0;  ///< long side of the small copies in the report; 0: none

    bool keep_recipe = true;            ///< outputs carry their recipe
    std::filesystem::path recipe_file;  ///< empty: none
    bool force = false;                 ///< replace files that we did not make
    bool dry_run = false;               ///< check everything, write nothing
    std::uint64_t max_memory_bytes = 4ull << 30;
};

struct OutputReport {
    std::string path, format;
    Extent size_px;
    std::uint64_t bytes = 0;  ///< 0 in a dry run
    bool replaced = false;
};

/// What was done, or in a dry run would be.
struct RunReport {
    std::string input, input_xxh128, style;
    Extent picture, lattice;
    std::uint64_t seed = 0;
    std::vector<std::pair<std::string, std::size_t>> endpoints;  ///< per stage
    std::size_t unreached = 0, nodes = 0, strokes = 0;
    std::vector<OutputReport> outputs;
    std::string recipe;
    std::optional<DecoderConfinement> decoder;  ///< of the input, if there is one
    Picture small_input, small_drawing;         ///< as request.thumbnail_px asks for them
    bool dry_run = false;
};

/// Reads, draws, writes. Outputs are written when all of them are made, each whole or not at all. Reports
/// the steps "reading", those of stylize, "painting NAME" and "writing". Throws Error, which names a file
/// wherever one is concerned.
RunReport run(const RunRequest& request, PictureCodec& codec, const Work& work);

}  // namespace dstylize
