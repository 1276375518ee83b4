// Reading a style: TOML to tree, the base style's tree below it (`extends`), settings on top of it,
// then one walk over the parameters, which takes from the tree and remembers what it took. What is left
// over in the tree is a misspelt key.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>

#include <fmt/format.h>

#include "core/error.h"
#include "pipeline/detail_toml.h"
#include "pipeline/style_file.h"

namespace dstylize {
namespace {

constexpr int kMostExtends = 8;

struct Reader final : ParameterVisitor {
    Reader(toml::table& t, std::string path_, const std::string& origin_)
        : table(t), path(std::move(path_)), origin(origin_) {}

    toml::table& table;
    std::string path;
    const std::string& origin;
    std::vector<std::string> known;

    [[noreturn]] void fail(const toml::source_region& at, const std::string& problem, const std::string& remedy) const {
        std::string where = origin;
        if (at.begin.line > 0)
            where = fmt::format("{}:{}:{}", at.path ? *at.path : origin, at.begin.line, at.begin.column);
        throw Error(ErrorCode::bad_usage, where, problem, remedy);
    }
    [[noreturn]] void fail(const toml::node* node, const std::string& problem, const std::string& remedy) const {
        fail(node ? node->source() : toml::source_region{}, problem, remedy);
    }
    std::string full(std::string_view key) const {
        return path.empty() ? std::string(key) : path + "." + std::string(key);
    }
    toml::node* find(std::string_view key) {
        known.emplace_back(key);
        return table.get(key);
    }

    void number(ParameterDoc doc, float& value, float lo, float hi) override {
        toml::node* node = find(doc.key);
        if (!node) return;
        const auto given = node->value<double>();
        if (!given) fail(node, full(doc.key) + " is not a number", fmt::format("give a number from {} to {}", lo, hi));
        if (!(*given >= double(lo) && *given <= double(hi)))
            fail(node, fmt::format("{} = {} is out of range", full(doc.key), *given),
                 fmt::format("give a number from {} to {}", lo, hi));
        value = float(*given);
    }
    void integer(ParameterDoc doc, int& value, int lo, int hi) override {
        toml::node* node = find(doc.key);
        if (!node) return;
        const auto given = node->is_integer() ? node->value<std::int64_t>() : std::nullopt;
        const std::string range = fmt::format("give a whole number from {} to {}", lo, hi);
        if (!given) fail(node, full(doc.key) + " is not a whole number", range);
        if (*given < lo || *given > hi)
            fail(node, fmt::format("{} = {} is out of range", full(doc.key), *given), range);
        value = int(*given);
    }
    void flag(ParameterDoc doc, bool& value) override {
        toml::node* node = find(doc.key);
        if (!node) return;
        const auto given = node->is_boolean() ? node->value<bool>() : std::nullopt;
        if (!given) fail(node, full(doc.key) + " is neither true nor false", "give true or false");
        value = *given;
    }
    void choice(ParameterDoc doc, int& value, std::span<const std::string_view> names) override {
        toml::node* node = find(doc.key);
        if (!node) return;
        std::string given = node->value_or(std::string());
        if (node->is_integer()) given = std::to_string(node->value_or(std::int64_t{}));
        const auto at = std::find(names.begin(), names.end(), given);
        if (at == names.end())
            fail(node, fmt::format("{} = '{}' is not known", full(doc.key), given),
                 fmt::format("use one of {}", fmt::join(names, ", ")));
        value = int(at - names.begin());
    }
    void colour(ParameterDoc doc, Rgba& value) override {
        toml::node* node = find(doc.key);
        if (!node) return;
        const std::string given = node->value_or(std::string());
        unsigned rgb = 0;
        char rest = 0;
        if (given.size() != 7 || given[0] != '#' || std::sscanf(given.c_str() + 1, "%6x%c", &rgb, &rest) != 1 ||
            given.find_first_not_of("0123456789abcdefABCDEF", 1) != std::string::npos)
            fail(node, fmt::format("{} = '{}' is not a colour", full(doc.key), given), "give one like \"#20261a\"");
        value = {float(rgb >> 16) / 255, float(rgb >> 8 & 255) / 255, float(rgb & 255) / 255, 1};
    }
    void text(ParameterDoc doc, std::string& value) override {
        toml::node* node = find(doc.key);
        if (!node) return;
        if (!node->is_string()) fail(node, full(doc.key) + " is not text", "put it in quotes");
        value = node->value_or(std::string());
    }
    void field_weights(ParameterDoc doc, FieldWeights& value) override {
        toml::node* node = find(doc.key);
        if (!node) return;
        if (!node->is_table())
            fail(node, full(doc.key) + " is not a table of field weights", "write { field = weight }");
        const auto names = Fields::names();
        value.clear();
        for (auto&& [key, weight] : *node->as_table()) {
            const std::string field(key.str());
            if (std::find(names.begin(), names.end(), field) == names.end())
                fail(&weight, fmt::format("{}: no field is called '{}'", full(doc.key), field),
                     "did you mean '" + nearest_name(field, {names.begin(), names.end()}) + "'?");
            const auto given = weight.value<double>();
            if (!given || !(std::abs(*given) <= 100))
                fail(&weight, fmt::format("{}.{} is not a weight", full(doc.key), field),
                     "give a number from -100 to 100");
            value.emplace_back(field, float(*given));
        }
    }
    void section(std::string_view key, std::string_view, const std::function<void(ParameterVisitor&)>& visit) override {
        toml::table empty;
        toml::table* inner = &empty;
        if (toml::node* node = find(key)) {
            if (!node->is_table()) fail(node, full(key) + " is not a table", "write [" + full(key) + "]");
            inner = node->as_table();
        }
        Reader reader(*inner, full(key), origin);
        visit(reader);
        reader.reject_unknown();
    }
    void reject_unknown() const {
        for (auto&& [key, node] : table) {
            if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
            const std::string near = nearest_name(key.str(), known);
            fail(key.source(), "unknown key '" + full(key.str()) + "'",
                 near.empty() ? "`dstylize styles NAME` lists every key" : "did you mean '" + full(near) + "'?");
        }
    }
};

toml::table parsed(std::string_view text, const std::string& origin) {
    return parsed_toml(text, origin, ErrorCode::bad_usage, "correct the style file");
}

std::string stage_name(const toml::node& stage) {
    const toml::table* t = stage.as_table();
    return t ? (*t)["name"].value_or(std::string("growth")) : std::string();
}

/// The stage of that name in a style's tree, or nullptr.
toml::table* find_stage(toml::table& tree, std::string_view name) {
    toml::array* stages = tree["stage"].as_array();
    if (!stages) return nullptr;
    for (toml::node& stage : *stages)
        if (stage.is_table() && stage_name(stage) == name) return stage.as_table();
    return nullptr;
}

/// `over` on top of `base`, tables key by key, stages by name. Nodes are moved and keys kept whole, so
/// that both remember the lines that they came from.
void merge(toml::table& base, toml::table&& over) {
    for (auto&& [key, node] : over) {
        toml::node* below = base.get(key);
        if (key == "stage" && below && below->is_array() && node.is_array()) {
            for (toml::node& stage : *node.as_array()) {
                toml::table* same = find_stage(base, stage_name(stage));
                if (same && stage.is_table())
                    merge(*same, std::move(*stage.as_table()));
                else
                    stage.visit([&](auto& value) { below->as_array()->push_back(std::move(value)); });
            }
        } else if (below && below->is_table() && node.is_table()) {
            merge(*below->as_table(), std::move(*node.as_table()));
        } else {
            node.visit([&, &name = key](auto& value) { base.insert_or_assign(name, std::move(value)); });
        }
    }
}

std::string file_text(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    std::string text;
    try {
        text.assign(std::istreambuf_iterator<char>(in), {});
    } catch (const std::ios::failure&) {
        text.clear();
    }
    if (text.empty()) throw Error(ErrorCode::bad_usage, path, "the style file cannot be read", "check the path");
    return text;
}

std::string style_text(const std::string& name_or_file, const std::filesystem::path& user_folder, std::string& origin) {
    const bool is_file = name_or_file.find('/') != std::string::npos || name_or_file.ends_with(".toml");
    if (!is_file) {
        std::vector<std::string> names;
        for (const BuiltinStyle& style : builtin_styles()) {
            if (style.name == name_or_file) {
                origin = name_or_file + ".toml";
                return std::string(style.toml);
            }
            names.emplace_back(style.name);
        }
        for (const std::string& name : user_style_names(user_folder)) {
            names.push_back(name);
            if (name != name_or_file) continue;
            origin = (user_folder / (name + ".toml")).string();
            return file_text(origin);
        }
        const std::string near = nearest_name(name_or_file, names);
        throw Error(ErrorCode::bad_usage, "", "no style is called '" + name_or_file + "'",
                    near.empty() ? fmt::format("use one of {}, or a .toml file", fmt::join(names, ", "))
                                 : "did you mean '" + near + "'?");
    }
    origin = name_or_file;
    return file_text(origin);
}

toml::table resolved(toml::table own, const std::string& origin, const std::filesystem::path& user_folder, int depth) {
    const std::string base_name = own["style"]["extends"].value_or(std::string());
    if (base_name.empty()) return own;
    if (depth >= kMostExtends)
        throw Error(ErrorCode::bad_usage, origin, "styles extend one another in a circle",
                    "break the chain of `extends`");
    std::string base_origin;
    const std::string text = style_text(base_name, user_folder, base_origin);
    toml::table tree = resolved(parsed(text, base_origin), base_origin, user_folder, depth + 1);
    merge(tree, std::move(own));
    return tree;
}

/// Puts one setting into the tree; the reader judges it like any other value.
void apply(toml::table& tree, const Setting& setting) {
    const std::string origin = "--set " + setting.key;
    std::vector<std::string> path;
    std::string_view rest = setting.key;
    for (std::size_t dot = 0; (dot = rest.find('.')) != std::string_view::npos; rest.remove_prefix(dot + 1))
        path.emplace_back(rest.substr(0, dot));
    path.emplace_back(rest);
    if (path.size() < 2) throw Error(ErrorCode::bad_usage, origin, "not a parameter", "write section.key=value");

    toml::table* at = &tree;
    std::size_t k = 0;
    if (path[0] == "stage") {
        at = path.size() > 2 ? find_stage(tree, path[1]) : nullptr;
        if (!at) {
            std::vector<std::string> names;
            if (const toml::array* stages = tree["stage"].as_array())
                for (const toml::node& stage : *stages) names.push_back(stage_name(stage));
            throw Error(ErrorCode::bad_usage, origin, "this style has no such stage",
                        fmt::format("its stages are {}", fmt::join(names, ", ")));
        }
        k = 2;
    }
    for (; k + 1 < path.size(); ++k) {
        toml::node* inner = at->get(path[k]);
        if (!inner) inner = &at->insert(path[k], toml::table{}).first->second;
        at = inner->as_table();
        if (!at)
            throw Error(ErrorCode::bad_usage, origin, "'" + path[k] + "' is not a table", "write section.key=value");
    }
    try {
        toml::table value = parsed("v = " + setting.value, origin);
        at->insert_or_assign(path.back(), *value.get("v"));
    } catch (const Error&) {
        at->insert_or_assign(path.back(), setting.value);
    }
}

}  // namespace

std::string nearest_name(std::string_view word, const std::vector<std::string>& candidates) {
    std::string best;
    std::size_t best_distance = word.size() / 2 + 2;
    for (const std::string& candidate : candidates) {
        std::vector<std::size_t> row(candidate.size() + 1);
        for (std::size_t j = 0; j < row.size(); ++j) row[j] = j;
        for (std::size_t i = 1; i <= word.size(); ++i) {
            std::size_t diagonal = row[0]++;
            for (std::size_t j = 1; j < row.size(); ++j) {
                const std::size_t replaced = diagonal + (word[i - 1] != candidate[j - 1]);
                diagonal = row[j];
                row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
            }
        }
        if (row.back() < best_distance) {
            best_distance = row.back();
            best = candidate;
        }
    }
    return best;
}

Style parse_style(std::string_view text, const std::string& origin, const std::vector<Setting>& settings,
                  const std::filesystem::path& user_folder) {
    toml::table tree = resolved(parsed(text, origin), origin, user_folder, 0);
    if (tree["recipe"].is_table()) tree.erase("recipe");  // a recipe is a style file too
    for (const Setting& setting : settings) apply(tree, setting);

    Style style;
    std::string extends;
    Reader top(tree, "", origin);
    top.section("style", "", [&](ParameterVisitor& v) {
        v.text({"name", "", ""}, style.name);
        v.text({"summary", "", ""}, style.summary);
        v.text({"extends", "", ""}, extends);
        v.text({"metaphor", "", ""}, style.metaphor_name);
    });
    if (style.name.find('/') != std::string::npos || style.name.starts_with('.'))
        top.fail(tree.at_path("style.name").node(), "style.name = \"" + style.name + "\" can be no folder's name",
                 "leave out slashes, and dots at its beginning");
    if (style.metaphor_name.empty())
        top.fail(tree.get("style"), "the style names no metaphor", "add style.metaphor = \"ink\"");
    style.metaphor = make_metaphor(style.metaphor_name);
    if (toml::node* stages = top.find("stage")) {
        if (!stages->is_array()) top.fail(stages, "'stage' is not a list of stages", "write [[stage]]");
        std::set<std::string> names;
        for (toml::node& node : *stages->as_array()) {
            if (!node.is_table()) top.fail(&node, "'stage' is not a list of stages", "write [[stage]]");
            Reader reader(*node.as_table(), "stage", origin);
            StageParameters stage;
            stage.visit(reader);
            reader.reject_unknown();
            if (!names.insert(stage.name).second)
                top.fail(&node, "two stages are called '" + stage.name + "'", "rename one");
            for (const std::string& field : {stage.endpoints.density, stage.endpoints.priority, stage.path_inside})
                if (const auto all = Fields::names();
                    !field.empty() && std::find(all.begin(), all.end(), field) == all.end())
                    top.fail(&node, "no field is called '" + field + "'",
                             "did you mean '" + nearest_name(field, {all.begin(), all.end()}) + "'?");
            style.stages.push_back(std::move(stage));
        }
    }
    if (style.stages.empty()) top.fail(nullptr, "the style has no stage", "add a [[stage]]");
    if (style.stages.front().sources != StageParameters::Sources::root)
        top.fail(tree.get("stage"), "the first stage cannot start from the dendrite", "use sources = \"root\"");
    std::vector<StageParameters> stages = std::move(style.stages);
    style.stages.clear();
    style.visit(top);
    style.stages = std::move(stages);
    const bool turns = std::any_of(style.stages.begin(), style.stages.end(),
                                   [](const StageParameters& stage) { return stage.turn_penalty > 0; });
    if (turns && style.lattice.kind == LatticeParameters::Kind::regular && style.lattice.jitter == 0)
        top.fail(tree.get("lattice"), "a turn_penalty means nothing on unmoved squares, with 8 directions to turn in",
                 "set lattice.kind to hexagon or scattered, or lattice.jitter above 0");
    top.reject_unknown();
    return style;
}

std::vector<std::string> user_style_names(const std::filesystem::path& user_folder) {
    std::vector<std::string> names;
    std::error_code none;  // no folder, no styles
    if (!user_folder.empty())
        for (const auto& entry : std::filesystem::directory_iterator(user_folder, none))
            if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

std::string style_source(const std::string& name_or_file, const std::filesystem::path& user_folder) {
    std::string origin;
    return style_text(name_or_file, user_folder, origin);
}

Style load_style(const std::string& name_or_file, const std::vector<Setting>& settings,
                 const std::filesystem::path& user_folder) {
    std::string origin;
    const std::string text = style_text(name_or_file, user_folder, origin);
    Style style = parse_style(text, origin, settings, user_folder);
    if (style.name.empty()) style.name = std::filesystem::path(name_or_file).stem().string();
    return style;
}

}  // namespace dstylize
