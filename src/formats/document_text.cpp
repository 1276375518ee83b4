// Only what our own writers write is understood (an SVG saved again by Inkscape included): no XML or PDF
// library is worth its weight for one text.
#include "formats/document_text.h"

#include <charconv>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>

namespace dstylize {
namespace {

void append_utf8(std::string& out, std::uint32_t c) {
    if (c < 0x80) {
        out += char(c);
    } else if (c < 0x800) {
        out += char(0xc0 | c >> 6);
        out += char(0x80 | (c & 0x3f));
    } else if (c < 0x10000) {
        out += char(0xe0 | c >> 12);
        out += char(0x80 | (c >> 6 & 0x3f));
        out += char(0x80 | (c & 0x3f));
    } else {
        out += char(0xf0 | c >> 18);
        out += char(0x80 | (c >> 12 & 0x3f));
        out += char(0x80 | (c >> 6 & 0x3f));
        out += char(0x80 | (c & 0x3f));
    }
}

std::optional<std::uint32_t> number(std::string_view digits, int base) {
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, base);
    if (error != std::errc{} || end != digits.data() + digits.size()) return {};
    return value;
}

/// The text of an XML reference, without its & and ;.
std::optional<std::uint32_t> character(std::string_view reference) {
    if (reference == "amp") return '&';
    if (reference == "lt") return '<';
    if (reference == "gt") return '>';
    if (reference == "quot") return '"';
    if (reference == "apos") return '\'';
    if (reference.starts_with("#x")) return number(reference.substr(2), 16);
    if (reference.starts_with("#")) return number(reference.substr(1), 10);
    return {};
}

std::string unescaped(std::string_view xml) {
    std::string out;
    while (!xml.empty()) {
        const std::size_t start = xml.find('&');
        out += xml.substr(0, start);
        if (start == std::string_view::npos) break;
        const std::size_t end = xml.find(';', start);
        if (end == std::string_view::npos) return {};
        const auto c = character(xml.substr(start + 1, end - start - 1));
        if (!c || *c > 0x10ffff) return {};
        append_utf8(out, *c);
        xml.remove_prefix(end + 1);
    }
    return out;
}

std::string svg_text(std::string_view file, std::string_view key) {
    std::string element = "<d:text key=\"";
    element.append(key).append("\"");
    std::size_t start = file.find(element);
    if (start != std::string_view::npos) start = file.find('>', start);
    if (start == std::string_view::npos) return {};
    const std::size_t end = file.find("</d:text>", ++start);
    return end == std::string_view::npos ? std::string{} : unescaped(file.substr(start, end - start));
}

/// Cairo writes keywords with line breaks as UTF-16 in hexadecimal, and the document information last.
std::string pdf_keywords(std::string_view file) {
    constexpr std::string_view kStart = "/Keywords <FEFF";
    std::size_t at = file.rfind(kStart);
    if (at == std::string_view::npos) return {};
    at += kStart.size();
    std::string out;
    std::uint32_t high = 0;
    for (; at + 4 <= file.size() && file[at] != '>'; at += 4) {
        const auto unit = number(file.substr(at, 4), 16);
        if (!unit) return {};
        if (*unit >= 0xd800 && *unit < 0xdc00) {
            high = *unit;
        } else if (*unit >= 0xdc00 && *unit < 0xe000) {
            if (high == 0) return {};
            append_utf8(out, 0x10000 + ((high - 0xd800) << 10) + (*unit - 0xdc00));
            high = 0;
        } else {
            append_utf8(out, *unit);
        }
    }
    return out;
}

std::string json_text(std::string_view file, std::string_view key) {
    const auto tree = nlohmann::json::parse(file, nullptr, false);
    if (!tree.is_object()) return {};
    const auto info = tree.find("info");
    if (info == tree.end() || !info->is_object()) return {};
    const auto text = info->find(std::string(key));
    return text != info->end() && text->is_string() ? text->get<std::string>() : std::string{};
}

std::string_view without_blanks(std::string_view file) {
    if (file.starts_with("\xef\xbb\xbf")) file.remove_prefix(3);
    const std::size_t first = file.find_first_not_of(" \t\r\n");
    return first == std::string_view::npos ? std::string_view{} : file.substr(first);
}

}  // namespace

bool is_document(std::string_view file) {
    const std::string_view start = without_blanks(file);
    return start.starts_with("%PDF") || start.starts_with("{") || start.starts_with("<?xml") ||
           start.starts_with("<svg");
}

std::string document_text(std::string_view file, std::string_view key) {
    const std::string_view start = without_blanks(file);
    if (start.starts_with("%PDF")) return key == "recipe" ? pdf_keywords(start) : std::string{};
    if (start.starts_with("{")) return json_text(start, key);
    return svg_text(start, key);
}

}  // namespace dstylize
