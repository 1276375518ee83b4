#include <algorithm>
#include <cmath>

#include "formats/detail_vector.h"
#include "geometry/stroke_outline.h"

namespace dstylize {
namespace {

constexpr float kTolerance_u = 0.05f;
/// Shares of the tolerance: what smoothing, thinning and arcs may take together leaves most to the fit.
constexpr float kSmoothShare = 0.2f, kFitShare = 0.6f;

struct Key {
    bool strokes;
    std::uint8_t stage;
    std::uint16_t order;
    friend auto operator<=>(const Key&, const Key&) = default;
};

Key key_of(const Item& item) {
    if (const auto* stroke = std::get_if<VariableStroke>(&item)) return {true, stroke->stage, stroke->order};
    return {false, 0, 0};
}

Rgba colour_of(const Item& item) {
    return std::visit([](const auto& it) { return it.colour; }, item);
}

CubicPath path_of(const Item& item, float tolerance) {
    if (const auto* fill = std::get_if<Fill>(&item)) return fitted_path(fill->outline_px, kFitShare * tolerance);
    const auto& stroke = std::get<VariableStroke>(item);
    const float fine = kSmoothShare * tolerance;
    const TaperedLine line = simplified(smooth_line(stroke.points_px, stroke.width_px, fine), fine);
    return fitted_path(stroke_outline(line, fine), kFitShare * tolerance);
}

/// Length of the well-formed UTF-8 sequence that the text starts with, and its code point; 0 if none.
std::size_t sequence(std::string_view text, char32_t& code) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char lead = byte(0);
    const std::size_t size = lead < 0x80 ? 1 : lead >> 5 == 6 ? 2 : lead >> 4 == 14 ? 3 : lead >> 3 == 30 ? 4 : 0;
    if (size == 0 || size > text.size()) return 0;
    code = size == 1 ? lead : lead & (0x7Fu >> size);
    for (std::size_t i = 1; i < size; ++i) {
        if (byte(i) >> 6 != 2) return 0;
        code = code << 6 | (byte(i) & 0x3Fu);
    }
    constexpr char32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
    return code < kLeast[size] || code > 0x10FFFF || (code >= 0xD800 && code <= 0xDFFF) ? 0 : size;
}

bool xml_allows(char32_t code) {
    return code == '\t' || code == '\n' || code == '\r' || (code >= 0x20 && code != 0xFFFE && code != 0xFFFF);
}

}  // namespace

ShapeLayer shape_layer(const Layer& layer, float tolerance_px) {
    ShapeLayer out;
    out.name = clean_text(layer.name);
    out.light = layer.glow.has_value();
    std::vector<const Item*> items;
    for (const Item& item : layer.items) items.push_back(&item);
    out.one_colour = !items.empty() && std::ranges::all_of(items, [&](const Item* item) {
        return colour_of(*item) == colour_of(*items[0]);
    });
    const bool merges = layer.blend == Blend::max && out.one_colour;
    if (merges) {
        std::ranges::stable_sort(items, {}, [](const Item* item) { return key_of(*item); });
        out.opacity = colour_of(*items[0]).a;
    }
    for (const Item* item : items) {
        Shape shape{path_of(*item, tolerance_px), colour_of(*item)};
        if (shape.path.pieces.empty()) continue;
        if (merges) shape.colour.a = 1;
        const Key key = key_of(*item);
        if (out.groups.empty() ||
            Key{out.groups.back().strokes, out.groups.back().stage, out.groups.back().order} != key)
            out.groups.push_back({key.strokes, key.stage, key.order, {}});
        out.groups.back().shapes.push_back(std::move(shape));
    }
    return out;
}

float shape_tolerance_px(const DisplayList& list) {
    return std::max(0.01f, kTolerance_u * std::max(list.width_px, list.height_px) / 1024);
}

PageSize page_size(const DisplayList& list, const DocumentInfo& info) {
    constexpr double kMmPerPx = 25.4 / 96;
    const double ratio = double(list.height_px) / double(list.width_px);
    if (info.width_mm > 0) return {info.width_mm, info.height_mm > 0 ? info.height_mm : info.width_mm * ratio};
    if (info.height_mm > 0) return {info.height_mm / ratio, info.height_mm};
    return {list.width_px * kMmPerPx, list.height_px * kMmPerPx};
}

std::string_view text_of(const DocumentInfo& info, std::string_view key) {
    for (const auto& [name, text] : info.text)
        if (name == key) return text;
    return {};
}

std::string clean_text(std::string_view text) {
    std::string clean;
    clean.reserve(text.size());
    while (!text.empty()) {
        char32_t code = 0;
        const std::size_t size = sequence(text, code);
        clean += size > 0 && xml_allows(code) ? text.substr(0, size) : std::string_view("\xEF\xBF\xBD");
        text.remove_prefix(std::max<std::size_t>(size, 1));
    }
    return clean;
}

}  // namespace dstylize
