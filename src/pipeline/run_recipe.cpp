#include "pipeline/run_recipe.h"

#include <fmt/format.h>

#include "pipeline/control_text.h"
#include "pipeline/version.h"

namespace dstylize {

Recipe recipe_of(const RunRequest& request, std::string style_toml) {
    Recipe recipe;
    recipe.program = fmt::format("dstylize {}", version());
    recipe.seed = request.seed;
    recipe.importance_replaces = request.importance_replaces;
    recipe.no_picture = request.no_picture;
    for (const RootChoice& root : request.roots) recipe.roots.push_back(root_text(root));
    switch (request.background.kind) {
        case Background::Kind::input: recipe.background = "input"; break;
        case Background::Kind::none: recipe.background = "none"; break;
        case Background::Kind::colour: recipe.background = colour_text(request.background.colour); break;
        case Background::Kind::style:
        case Background::Kind::file: break;
    }
    if (request.place) recipe.place = place_text(*request.place);
    recipe.writing = request.writing;
    recipe.size = output_size_text(request.size);
    recipe.style_toml = std::move(style_toml);
    return recipe;
}

}  // namespace dstylize
