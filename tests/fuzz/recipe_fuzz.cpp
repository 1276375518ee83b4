// Any text is a recipe or an Error; what a recipe is written as reads back as the same recipe.
#include <cstddef>
#include <cstdint>

#include "core/error.h"
#include "law.h"
#include "pipeline/recipe.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const dstylize::Recipe recipe =
            dstylize::parse_recipe({reinterpret_cast<const char*>(data), size}, "recipe.toml");
        const std::string written = dstylize::recipe_toml(recipe);
        law(dstylize::recipe_toml(dstylize::parse_recipe(written, "written.toml")) == written,
            "a written recipe reads back");
    } catch (const dstylize::Error& error) {
        law(error.file() != "written.toml", "a written recipe can be read");
    }
    return 0;
}
