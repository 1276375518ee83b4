// Writing a style: the same walk over the parameters as reading, to TOML and to the table that
// `dstylize styles NAME` prints.
#include <fmt/format.h>

#include <cmath>

#include "pipeline/style_file.h"

namespace dstylize {
namespace {

std::string toml_text(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        if (c == '\n')
            out += "\\n";
        else
            out += c;
    }
    return out + '"';
}
std::string hex(Rgba c) {
    const auto byte = [](float v) { return int(std::lround(v * 255)); };
    return fmt::format("#{:02x}{:02x}{:02x}", byte(c.r), byte(c.g), byte(c.b));
}
std::string decimal(float value) {
    std::string text = fmt::format("{}", value);
    return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

struct Writer final : ParameterVisitor {
    std::string out, path;

    void line(ParameterDoc doc, const std::string& value) { out += fmt::format("{} = {}\n", doc.key, value); }
    void number(ParameterDoc doc, float& value, float, float) override { line(doc, decimal(value)); }
    void integer(ParameterDoc doc, int& value, int, int) override { line(doc, std::to_string(value)); }
    void flag(ParameterDoc doc, bool& value) override { line(doc, value ? "true" : "false"); }
    void choice(ParameterDoc doc, int& value, std::span<const std::string_view> names) override {
        line(doc, toml_text(names[std::size_t(value)]));
    }
    void colour(ParameterDoc doc, Rgba& value) override { line(doc, toml_text(hex(value))); }
    void text(ParameterDoc doc, std::string& value) override { line(doc, toml_text(value)); }
    void field_weights(ParameterDoc doc, FieldWeights& value) override {
        std::vector<std::string> parts;
        for (const auto& [field, weight] : value) parts.push_back(fmt::format("{} = {}", field, decimal(weight)));
        line(doc, fmt::format("{{ {} }}", fmt::join(parts, ", ")));
    }
    void section(std::string_view key, std::string_view, const std::function<void(ParameterVisitor&)>& visit) override {
        Writer inner;
        if (key.starts_with("stage.")) {
            inner.path = "stage";
            out += "\n[[stage]]\n";
        } else {
            inner.path = path.empty() ? std::string(key) : path + "." + std::string(key);
            out += fmt::format("\n[{}]\n", inner.path);
        }
        visit(inner);
        out += inner.out;
    }
};

struct Describer final : ParameterVisitor {
    std::string out, path;

    void row(ParameterDoc doc, const std::string& value, const std::string& range) {
        const std::string with_unit = doc.unit.empty() ? value : fmt::format("{} {}", value, doc.unit);
        out += fmt::format("  {:<22} {:<16} {:<16} {}\n", doc.key, with_unit, range, doc.meaning);
    }
    void number(ParameterDoc doc, float& value, float lo, float hi) override {
        row(doc, fmt::format("{}", value), fmt::format("{} … {}", lo, hi));
    }
    void integer(ParameterDoc doc, int& value, int lo, int hi) override {
        row(doc, std::to_string(value), fmt::format("{} … {}", lo, hi));
    }
    void flag(ParameterDoc doc, bool& value) override { row(doc, value ? "true" : "false", "true, false"); }
    void choice(ParameterDoc doc, int& value, std::span<const std::string_view> names) override {
        row(doc, std::string(names[std::size_t(value)]), fmt::format("{}", fmt::join(names, "|")));
    }
    void colour(ParameterDoc doc, Rgba& value) override { row(doc, hex(value), "#rrggbb"); }
    void text(ParameterDoc doc, std::string& value) override { row(doc, value, "text"); }
    void field_weights(ParameterDoc doc, FieldWeights& value) override {
        row(doc, "", "-100 … 100");
        for (const auto& [field, weight] : value) out += fmt::format("    {:<20} {}\n", field, weight);
    }
    void section(std::string_view key, std::string_view meaning,
                 const std::function<void(ParameterVisitor&)>& visit) override {
        Describer inner;
        inner.path = path.empty() ? std::string(key) : path + "." + std::string(key);
        out += fmt::format("\n{}: {}\n", inner.path, meaning);
        visit(inner);
        out += inner.out;
    }
};

}  // namespace

std::string style_toml(Style& style) {
    Writer writer;
    writer.out = fmt::format("[style]\nname = {}\nsummary = {}\nmetaphor = {}\n", toml_text(style.name),
                             toml_text(style.summary), toml_text(style.metaphor_name));
    style.visit(writer);
    return writer.out;
}

std::string style_description(Style& style) {
    Describer describer;
    style.visit(describer);
    return fmt::format("{}: {}\n{}", style.name, style.summary, describer.out);
}

}  // namespace dstylize
