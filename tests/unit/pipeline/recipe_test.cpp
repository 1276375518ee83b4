#include "pipeline/recipe.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "pipeline/content_hash.h"
#include "pipeline/style_file.h"

namespace dstylize {
namespace {

Recipe full_recipe() {
    Recipe recipe;
    recipe.program = "dstylize 0.1.0";
    recipe.seed = 0x7fffffffffffffff;
    recipe.input = {"a \"quoted\" ' name\\with\nodd é parts.png", "00ff"};
    recipe.mask = FileMark{"mask.png", "11"};
    recipe.importance = FileMark{"map.png", "22"};
    recipe.importance_replaces = true;
    recipe.background_file = FileMark{"wall.jpg", "33"};
    recipe.size = "300mm@300dpi";
    recipe.roots = {"bottom", "0.5,12"};
    Style style = load_style("vine");
    recipe.style_toml = style_toml(style);
    return recipe;
}

TEST(Recipe, ItReadsBackAsWritten) {
    const Recipe recipe = full_recipe();
    const std::string text = recipe_toml(recipe);
    Recipe again = parse_recipe(text, "test");
    EXPECT_EQ(again.style_toml, text) << "a recipe is a style file";
    again.style_toml = recipe.style_toml;
    EXPECT_EQ(recipe_toml(again), text);
    EXPECT_EQ(again.seed, recipe.seed);
    EXPECT_EQ(again.input.name, recipe.input.name);
    EXPECT_EQ(again.roots, recipe.roots);
    EXPECT_TRUE(again.importance_replaces);
    EXPECT_FALSE(again.endpoints);
}

TEST(Recipe, TheStyleReaderTakesIt) {
    const Recipe recipe = full_recipe();
    Style style = parse_style(recipe_toml(recipe), "test");
    EXPECT_EQ(style_toml(style), recipe.style_toml);
    EXPECT_THROW(parse_style("recipe = 3\n" + recipe.style_toml, "test"), Error) << "only a table is tolerated";
}

TEST(Recipe, AFileNameNeedNotBeUtf8) {
    Recipe recipe = full_recipe();
    recipe.input.name = "caf\xe9.png";
    EXPECT_EQ(parse_recipe(recipe_toml(recipe), "test").input.name, "caf\xef\xbf\xbd.png");
}

TEST(Recipe, DamageIsRefused) {
    for (const char* text :
         {"", "[style]\n", "recipe = 1\n", "[recipe]\n", "[recipe]\nseed = -1\n", "[recipe]\nseed = 'x'\n",
          "[recipe]\nseed = 1\nroots = 'bottom'\n", "[recipe]\nseed = 1\nroots = [1]\n",
          "[recipe]\nseed = 1\nmask = 'm.png'\n", "[recipe]\nseed = 1\nmask = { name = 'm.png' }\n",
          "[recipe]\nseed = 1\nimportance_mode = 'add'\n", "[recipe"}) {
        try {
            parse_recipe(text, "test");
            ADD_FAILURE() << text;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::cannot_read) << text;
        }
    }
}

TEST(ContentHash, IsXxh3Of128Bits) {
    EXPECT_EQ(content_hash({}), "99aa06d3014798d86001c324468d497f");  // the reference implementation's of nothing
    const std::byte a[]{std::byte{1}}, b[]{std::byte{2}};
    EXPECT_NE(content_hash(a), content_hash(b));
}

}  // namespace
}  // namespace dstylize
