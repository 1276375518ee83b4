#include "pipeline/output_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "pipeline/style_file.h"

namespace dstylize {
namespace {

constexpr double kMmPerInch = 25.4;

struct PaperSheet {
    std::string_view name;
    double short_mm, long_mm;
};
constexpr PaperSheet kSheets[] = {
    {"a0", 841, 1189}, {"a1", 594, 841},         {"a2", 420, 594},        {"a3", 297, 420},
    {"a4", 210, 297},  {"a5", 148, 210},         {"a6", 105, 148},        {"b0", 1000, 1414},
    {"b1", 707, 1000}, {"b2", 500, 707},         {"b3", 353, 500},        {"b4", 250, 353},
    {"b5", 176, 250},  {"letter", 215.9, 279.4}, {"legal", 215.9, 355.6}, {"tabloid", 279.4, 431.8},
};

[[noreturn]] void refuse(std::string_view text, const std::string& problem, const std::string& remedy) {
    throw Error(ErrorCode::bad_usage, "", fmt::format("--size {}: {}", text, problem), remedy);
}

std::string lower(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    return out;
}

/// Takes a number off the front of `text`; false when there is none.
bool take_number(std::string_view& text, double& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
    if (error != std::errc{} || !std::isfinite(value)) return false;
    text.remove_prefix(std::size_t(end - text.data()));
    return true;
}

double mm_per(std::string_view unit) {
    if (unit == "mm") return 1;
    if (unit == "cm") return 10;
    if (unit == "in") return kMmPerInch;
    if (unit == "m") return 1000;
    return 0;
}

std::string sheet_names() {
    std::vector<std::string_view> names;
    for (const PaperSheet& sheet : kSheets) names.push_back(sheet.name);
    return fmt::format("{}", fmt::join(names, ", "));
}

int pixels(double side) {
    if (!(side < kLongestDrawing_px + 0.5))
        throw Error(ErrorCode::bad_usage, "", fmt::format("the output would be {:.0f} pixels long", side),
                    fmt::format("ask for a --size, --scale or dpi that gives at most {}", kLongestDrawing_px));
    return std::max(1, int(std::lround(side)));
}

}  // namespace

OutputSize parsed_output_size(std::string_view text) {
    constexpr double kMostDpi = 10000;
    static const std::string kHow = "give pixels (2400), a share (150%), a length (30cm@300dpi) or a paper (A3)";
    OutputSize size;
    const std::string whole = lower(text);
    std::string_view rest = whole;
    const std::size_t at = rest.find('@');
    if (at != std::string_view::npos) {
        std::string_view dpi = rest.substr(at + 1);
        rest = rest.substr(0, at);
        if (!take_number(dpi, size.dpi) || (dpi != "dpi" && !dpi.empty()) || !(size.dpi >= 1 && size.dpi <= kMostDpi))
            refuse(text, "the part after @ is not a resolution",
                   fmt::format("write 30cm@300dpi, 1 to {} dpi", kMostDpi));
    }
    if (!take_number(rest, size.value)) {
        const auto* sheet =
            std::find_if(std::begin(kSheets), std::end(kSheets), [&](const PaperSheet& s) { return s.name == rest; });
        if (sheet == std::end(kSheets))
            refuse(text, "neither a size nor a paper", kHow + "; papers are " + sheet_names());
        size.kind = OutputSize::Kind::paper;
        size.value = 0;
        size.paper = sheet->name;
        size.paper_short_mm = sheet->short_mm;
        size.paper_long_mm = sheet->long_mm;
        return size;
    }
    if (!(size.value > 0)) refuse(text, "not above zero", kHow);
    if (rest == "%") {
        size.kind = OutputSize::Kind::scale;
        size.value /= 100;
    } else if (const double mm = mm_per(rest); mm > 0) {
        size.kind = OutputSize::Kind::length;
        size.value *= mm;
    } else if (rest.empty() || rest == "px") {
        size.kind = OutputSize::Kind::long_side;
        if (size.value != std::floor(size.value)) refuse(text, "not a whole number of pixels", kHow);
    } else {
        refuse(text, fmt::format("unknown unit '{}'", rest), "use px, %, mm, cm, m or in");
    }
    if (at != std::string_view::npos && size.kind != OutputSize::Kind::length)
        refuse(text, "pixels have no resolution of their own", "give the length: 30cm@300dpi");
    return size;
}

std::string output_size_text(const OutputSize& size) {
    switch (size.kind) {
        case OutputSize::Kind::as_input: return "";
        case OutputSize::Kind::long_side: return fmt::format("{}", size.value);
        case OutputSize::Kind::scale: return fmt::format("{}%", size.value * 100);
        case OutputSize::Kind::length: return fmt::format("{}mm@{}dpi", size.value, size.dpi);
        case OutputSize::Kind::paper: return fmt::format("{}@{}dpi", size.paper, size.dpi);
    }
    return "";
}

OutputFrame output_frame(const OutputSize& size, Extent picture) {
    using Kind = OutputSize::Kind;
    double scale = 1;
    const double long_side = picture.long_side(), short_side = std::min(picture.x, picture.y);
    switch (size.kind) {
        case Kind::as_input: break;
        case Kind::long_side: scale = size.value / long_side; break;
        case Kind::scale: scale = size.value; break;
        case Kind::length: scale = size.value / kMmPerInch * size.dpi / long_side; break;
        case Kind::paper:
            scale = std::min(size.paper_long_mm / long_side, size.paper_short_mm / short_side) / kMmPerInch * size.dpi;
            break;
    }
    OutputFrame frame;
    frame.size_px = {pixels(picture.x * scale), pixels(picture.y * scale)};
    if (size.kind == Kind::length || size.kind == Kind::paper) {
        frame.dpi = size.dpi;
        frame.width_mm = picture.x * scale / size.dpi * kMmPerInch;
        frame.height_mm = picture.y * scale / size.dpi * kMmPerInch;
    }
    return frame;
}

}  // namespace dstylize
