#include "pipeline/control_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/error.h"
#include "pipeline/style_file.h"

namespace dstylize {
namespace {

constexpr std::string_view kPlaces[] = {"bottom", "top", "centre", "darkest"};

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlank = " \t\r";
    const std::size_t first = text.find_first_not_of(kBlank);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::optional<Coordinate> parsed_coordinate(std::string_view text) {
    Coordinate out;
    const auto [end, error] =
        std::from_chars(text.data(), text.data() + text.size(), out.value, std::chars_format::fixed);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(out.value)) return {};
    out.is_fraction = text.find('.') != std::string_view::npos;
    return out;
}

bool inside(Coordinate c, int side_px) {
    return c.value >= 0 && (c.is_fraction ? c.value <= 1 : c.value <= side_px - 1);
}

/// Takes the part before the next comma.
std::string_view take_part(std::string_view& text) {
    const std::size_t comma = text.find(',');
    const std::string_view part = trimmed(text.substr(0, comma));
    text = comma == std::string_view::npos ? std::string_view{} : text.substr(comma + 1);
    return part;
}

}  // namespace

RootChoice parsed_root(std::string_view text) {
    for (std::size_t i = 0; i < std::size(kPlaces); ++i)
        if (text == kPlaces[i]) return {RootParameters::Place(int(i)), {}, {}};
    if (text == "center") return {RootParameters::Place::centre, {}, {}};
    std::string_view rest = text;
    const auto x = parsed_coordinate(take_part(rest)), y = parsed_coordinate(trimmed(rest));
    if (!x || !y)
        throw Error(ErrorCode::bad_usage, "", fmt::format("--root {}: not a place", text),
                    "give x,y (0.5,0.9 is a fraction, 320,450 a pixel), bottom, top, centre or darkest");
    return {{}, *x, *y};
}

std::string root_text(const RootChoice& root) {
    if (root.place) return std::string(kPlaces[std::size_t(*root.place)]);
    return coordinate_text(root.x) + "," + coordinate_text(root.y);
}

std::string coordinate_text(Coordinate c) {
    std::string text = fmt::format("{}", c.value);
    if (c.is_fraction && text.find('.') == std::string::npos) text += ".0";
    return text;
}

std::vector<Coordinate> parsed_coordinates(std::string_view text) {
    std::vector<Coordinate> out;
    const auto parts = 1 + std::count(text.begin(), text.end(), ',');
    for (std::ptrdiff_t i = 0; i < parts; ++i) {
        const auto part = parsed_coordinate(take_part(text));
        if (!part) return {};
        out.push_back(*part);
    }
    return out;
}

std::vector<EndpointRow> endpoint_rows(std::string_view text, const std::string& name) {
    std::vector<EndpointRow> rows;
    int line_number = 0;
    bool heading_may_come = true;
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        std::string_view line = trimmed(text.substr(0, end));
        text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
        ++line_number;
        if (line.empty() || line.front() == '#') continue;
        std::string_view rest = line;
        const std::string_view first = take_part(rest), second = take_part(rest), stage = take_part(rest);
        if (heading_may_come && first == "x" && second == "y") {
            heading_may_come = false;
            continue;
        }
        heading_may_come = false;
        const auto x = parsed_coordinate(first), y = parsed_coordinate(second);
        if (!x || !y || !rest.empty())
            throw Error(ErrorCode::cannot_read, fmt::format("{}:{}", name, line_number), "not an endpoint",
                        "write x,y or x,y,STAGE; 0.5 is a fraction, 320 a pixel");
        rows.push_back({*x, *y, std::string(stage)});
    }
    if (rows.empty()) throw Error(ErrorCode::cannot_read, name, "holds no endpoint", "write x,y on a line for each");
    return rows;
}

void check_endpoints(const std::vector<EndpointRow>& rows, Extent picture, const std::vector<std::string>& stages,
                     const std::string& name) {
    for (const EndpointRow& row : rows) {
        if (!inside(row.x, picture.x) || !inside(row.y, picture.y))
            throw Error(
                ErrorCode::cannot_read, name,
                fmt::format("endpoint {},{} lies outside the picture", coordinate_text(row.x), coordinate_text(row.y)),
                fmt::format("it is {} x {} pixels; fractions go from 0.0 to 1.0", picture.x, picture.y));
        if (!row.stage.empty() && std::find(stages.begin(), stages.end(), row.stage) == stages.end())
            throw Error(ErrorCode::cannot_read, name, fmt::format("the style has no stage '{}'", row.stage),
                        fmt::format("its stages are {}", fmt::join(stages, ", ")));
    }
}

std::optional<Rgba> parsed_colour(std::string_view text) {
    unsigned rgb = 0;
    if (text.size() != 7 || text[0] != '#') return {};
    const auto [end, error] = std::from_chars(text.data() + 1, text.data() + text.size(), rgb, 16);
    if (error != std::errc{} || end != text.data() + text.size()) return {};
    return Rgba{float(rgb >> 16) / 255, float(rgb >> 8 & 255) / 255, float(rgb & 255) / 255, 1};
}

std::string colour_text(Rgba c) {
    const auto byte = [](float v) { return int(std::lround(v * 255)); };
    return fmt::format("#{:02x}{:02x}{:02x}", byte(c.r), byte(c.g), byte(c.b));
}

}  // namespace dstylize
