#include "pipeline/recipe.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "core/error.h"
#include "formats/document_text.h"
#include "pipeline/control_text.h"
#include "pipeline/detail_toml.h"

namespace dstylize {
namespace {

/// File names are bytes, TOML is UTF-8: what is not valid becomes U+FFFD.
std::string utf8(const std::string& text) {
    using nlohmann::json;
    return json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace)).get<std::string>();
}

toml::table table(const FileMark& mark) {
    toml::table out{{"name", utf8(mark.name)}, {"xxh128", mark.xxh128}};
    out.is_inline(true);
    return out;
}

class RecipeReader {
  public:
    RecipeReader(const toml::table& table, const std::string& origin) : table_(table), origin_(origin) {}

    std::string text(std::string_view key) const {
        const toml::node* node = table_.get(key);
        if (!node) return "";
        if (!node->is_string()) refuse(key);
        return node->value_or(std::string());
    }
    std::uint64_t number(std::string_view key) const {
        const toml::node* node = table_.get(key);
        const auto value = node && node->is_integer() ? node->value<std::int64_t>() : std::nullopt;
        if (!value || *value < 0) refuse(key);
        return std::uint64_t(*value);
    }
    std::vector<std::string> texts(std::string_view key) const {
        std::vector<std::string> out;
        const toml::node* node = table_.get(key);
        if (!node) return out;
        if (!node->is_array()) refuse(key);
        for (const toml::node& item : *node->as_array()) {
            if (!item.is_string()) refuse(key);
            out.push_back(item.value_or(std::string()));
        }
        return out;
    }
    std::optional<FileMark> mark(std::string_view key) const {
        const toml::node* node = table_.get(key);
        if (!node) return {};
        if (!node->is_table()) refuse(key);
        const RecipeReader inner(*node->as_table(), origin_);
        FileMark out{inner.text("name"), inner.text("xxh128")};
        if (out.name.empty() || out.xxh128.empty()) refuse(key);
        return out;
    }
    bool importance_replaces() const {
        const std::string mode = text("importance_mode");
        if (!mode.empty() && mode != "multiply" && mode != "replace" && mode != "none") refuse("importance_mode");
        return mode == "replace";
    }
    bool no_picture() const { return text("importance_mode") == "none"; }

    [[noreturn]] void refuse(std::string_view key) const {
        throw Error(ErrorCode::cannot_read, origin_, fmt::format("its recipe is damaged (recipe.{})", key),
                    "give a file that dstylize made");
    }

  private:
    const toml::table& table_;
    const std::string& origin_;
};

toml::table table(const Writing& writing) {
    const Lettering& l = writing.lettering;
    toml::table out{{"text", l.text},
                    {"font", l.font},
                    {"align", std::int64_t(l.align)},
                    {"letter_spacing", double(l.letter_spacing)},
                    {"line_spacing", double(l.line_spacing)},
                    {"size", double(writing.size)},
                    {"place", root_text({{}, writing.x, writing.y})}};
    out.is_inline(true);
    return out;
}

Writing parsed_writing(const toml::node& node, const RecipeReader& outer) {
    const toml::table* words = node.as_table();
    if (!words) outer.refuse("writing");
    Writing out;
    Lettering& l = out.lettering;
    const auto number = [&](const char* key, float value, float lo, float hi) {
        const float given = float((*words)[key].value_or(double(value)));
        if (!(given >= lo && given <= hi)) outer.refuse("writing");
        return given;
    };
    l.text = (*words)["text"].value_or(std::string());
    l.font = (*words)["font"].value_or(l.font);
    l.align = Lettering::Align(int(number("align", float(l.align), 0, 2)));
    l.letter_spacing = number("letter_spacing", l.letter_spacing, Writing::kLeastSpacing, Writing::kMostSpacing);
    l.line_spacing = number("line_spacing", l.line_spacing, Writing::kLeastLines, Writing::kMostLines);
    out.size = number("size", out.size, 0, Writing::kMostSize);
    const RootChoice place = parsed_root((*words)["place"].value_or(std::string("0.5,0.5")));
    if (place.place) outer.refuse("writing");
    out.x = place.x;
    out.y = place.y;
    return out;
}

std::string_view as_text(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

[[noreturn]] void no_recipe(const std::string& name) {
    throw Error(ErrorCode::cannot_read, name, "carries no recipe",
                "give a drawing or a recipe file that dstylize made without --no-recipe");
}

}  // namespace

std::string recipe_toml(const Recipe& recipe) {
    toml::table out{{"program", recipe.program}, {"seed", std::int64_t(recipe.seed)}};
    if (!recipe.input.name.empty()) out.insert("input", table(recipe.input));
    if (recipe.writing) out.insert("writing", table(*recipe.writing));
    const auto add_mark = [&](const char* key, const std::optional<FileMark>& mark) {
        if (mark) out.insert(key, table(*mark));
    };
    const auto add_text = [&](const char* key, const std::string& text) {
        if (!text.empty()) out.insert(key, text);
    };
    add_mark("importance", recipe.importance);
    if (recipe.importance) out.insert("importance_mode", recipe.importance_replaces ? "replace" : "multiply");
    if (recipe.no_picture) out.insert("importance_mode", "none");
    add_mark("mask", recipe.mask);
    add_mark("endpoints", recipe.endpoints);
    add_mark("background_file", recipe.background_file);
    add_text("background", recipe.background);
    add_text("place", recipe.place);
    add_text("size", recipe.size);
    if (!recipe.roots.empty()) {
        toml::array roots;
        for (const std::string& root : recipe.roots) roots.push_back(root);
        out.insert("roots", roots);
    }
    std::ostringstream text;
    text.exceptions(std::ios::badbit);  // or it would take in silence what no memory is left for
    text << "# How a drawing was made: `dstylize replay` makes it again, --style takes its style.\n[recipe]\n"
         << out << "\n\n"
         << recipe.style_toml;
    return text.str();
}

Recipe parse_recipe(std::string_view text, const std::string& origin) {
    const toml::table tree = parsed_toml(text, origin, ErrorCode::cannot_read, "give a file that dstylize made");
    const toml::table* table = tree["recipe"].as_table();
    if (!table) no_recipe(origin);
    const RecipeReader reader(*table, origin);
    Recipe out;
    out.program = reader.text("program");
    out.seed = reader.number("seed");
    out.input = reader.mark("input").value_or(FileMark{});
    out.importance = reader.mark("importance");
    out.importance_replaces = reader.importance_replaces();
    out.no_picture = reader.no_picture();
    out.mask = reader.mark("mask");
    out.endpoints = reader.mark("endpoints");
    out.background_file = reader.mark("background_file");
    out.background = reader.text("background");
    out.place = reader.text("place");
    out.size = reader.text("size");
    if (const toml::node* words = table->get("writing")) out.writing = parsed_writing(*words, reader);
    out.roots = reader.texts("roots");
    out.style_toml = text;
    return out;
}

std::string recipe_in_file(std::span<const std::byte> file, const std::string& name, PictureCodec& codec) {
    const std::string_view text = as_text(file);
    std::string found;
    if (name.ends_with(".toml"))
        found = text;
    else if (is_document(text))
        found = document_text(text, "recipe");
    else
        found = codec.decode(file, name).metadata.find("recipe");
    if (found.empty()) no_recipe(name);
    return found;
}

}  // namespace dstylize
