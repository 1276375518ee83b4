#include "pipeline/replay.h"

#include <fmt/format.h>

#include "core/error.h"
#include "formats/files.h"
#include "pipeline/control_text.h"
#include "pipeline/recipe.h"

namespace dstylize {
namespace {

namespace fs = std::filesystem;

class AuxiliaryFinder {
  public:
    AuxiliaryFinder(const fs::path& old, const fs::path& input) : old_(old), input_(input) {}

    AuxiliaryFile operator()(const std::optional<FileMark>& mark) const {
        if (!mark) return {};
        const fs::path named(mark->name);
        std::error_code ignored;
        for (const fs::path& candidate :
             {named, old_.parent_path() / named.filename(), input_.parent_path() / named.filename()})
            if (fs::exists(candidate, ignored)) return {candidate, mark->xxh128};
        throw Error(ErrorCode::cannot_read, mark->name, fmt::format("is missing; {} was made with it", old_.string()),
                    "put it back there, or beside the drawing or the input");
    }

  private:
    const fs::path &old_, &input_;
};

}  // namespace

Replay replay_of(const fs::path& old, const fs::path& input, PictureCodec& codec, std::uint64_t max_memory_bytes) {
    const std::string name = old == "-" ? "standard input" : old.string();
    const Recipe recipe = parse_recipe(recipe_in_file(read_file(old, max_memory_bytes), name, codec), name);
    const AuxiliaryFinder found(old, input);
    Replay out;
    out.input_xxh128 = recipe.input.xxh128;
    out.on_paper = recipe.input.name.empty();
    RunRequest& request = out.request;
    request.input = input;
    request.writing = recipe.writing;
    request.style = name;
    request.style_toml = recipe.style_toml;
    request.seed = recipe.seed;
    request.importance = found(recipe.importance);
    request.importance_replaces = recipe.importance_replaces;
    request.no_picture = recipe.no_picture;
    request.mask = found(recipe.mask);
    request.endpoints = found(recipe.endpoints);
    for (const std::string& root : recipe.roots) request.roots.push_back(parsed_root(root));
    if (const AuxiliaryFile file = found(recipe.background_file); !file.path.empty()) {
        request.background = {Background::Kind::file, {}, file.path};
        request.background_xxh128 = file.xxh128;
    } else if (!recipe.background.empty()) {
        request.background = parsed_background(recipe.background);
    }
    if (!recipe.place.empty()) request.place = parsed_place(recipe.place);
    if (!recipe.size.empty()) request.size = parsed_output_size(recipe.size);
    request.max_memory_bytes = max_memory_bytes;
    return out;
}

}  // namespace dstylize
