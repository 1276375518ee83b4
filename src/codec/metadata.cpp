#include "codec/metadata.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>

namespace dstylize::codec {
namespace {

struct KnownText {
    const char* key;
    const char* oiio_name;
    TiffTagId tag;
};
constexpr KnownText kKnown[] = {
    {"author", "Artist", TiffTagId::artist},
    {"copyright", "Copyright", TiffTagId::copyright},
    {"description", "ImageDescription", TiffTagId::description},
    {"software", "Software", TiffTagId::software},
};

/// Bytes of the UTF-8 character that starts `text`; 0 when there is none.
std::size_t utf8_length(std::string_view text) {
    const auto byte = [&](std::size_t n) { return static_cast<unsigned char>(text[n]); };
    const unsigned char first = byte(0);
    const std::size_t length = first < 0x80   ? 1
                               : first < 0xc2 ? 0
                               : first < 0xe0 ? 2
                               : first < 0xf0 ? 3
                               : first < 0xf5 ? 4
                                              : 0;
    if (length == 0 || length > text.size()) return 0;
    for (std::size_t n = 1; n < length; ++n)
        if ((byte(n) & 0xc0) != 0x80) return 0;
    // Over-long forms, surrogates and what lies above U+10FFFF.
    if ((first == 0xe0 && byte(1) < 0xa0) || (first == 0xed && byte(1) >= 0xa0)) return 0;
    if ((first == 0xf0 && byte(1) < 0x90) || (first == 0xf4 && byte(1) >= 0x90)) return 0;
    return length;
}

bool is_utf8(std::string_view text) {
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        if (length == 0) return false;
        text.remove_prefix(length);
    }
    return true;
}

bool is_xml_name(const std::string& key) {
    const auto letter = [](unsigned char c) { return c < 0x80 && (std::isalpha(c) || c == '_'); };
    return !key.empty() && letter(static_cast<unsigned char>(key[0])) &&
           std::ranges::all_of(key, [&](unsigned char c) { return letter(c) || std::isdigit(c) || c == '-'; });
}

bool is_own_key(const std::string& key) {
    return is_xml_name(key) && std::ranges::none_of(kKnown, [&](const KnownText& k) { return key == k.key; });
}

constexpr std::pair<char, std::string_view> kEntities[] = {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}};

std::string xml_escaped(const std::string& text) {
    std::string escaped;
    for (const char c : text) {
        const auto entity = std::ranges::find(kEntities, c, &std::pair<char, std::string_view>::first);
        if (entity == std::end(kEntities))
            escaped += c;
        else
            escaped += entity->second;
    }
    return escaped;
}

std::string xml_unescaped(std::string_view text) {
    std::string plain;
    while (!text.empty()) {
        const auto entity = std::ranges::find_if(kEntities, [&](const auto& e) { return text.starts_with(e.second); });
        const bool found = entity != std::end(kEntities);
        plain += found ? entity->first : text[0];
        text.remove_prefix(found ? entity->second.size() : 1);
    }
    return plain;
}

constexpr std::string_view kOwnPrefix = "dstylize:";

}  // namespace

std::string as_utf8(const std::string& text) {
    const bool latin1 = !is_utf8(text);
    std::string utf8;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if ((byte < 0x20 && c != '\t' && c != '\n') || byte == 0x7f || (latin1 && byte >= 0x80 && byte < 0xa0))
            continue;
        if (latin1 && byte >= 0x80) {
            utf8 += static_cast<char>(0xc0 | byte >> 6);
            utf8 += static_cast<char>(0x80 | (byte & 0x3f));
        } else {
            utf8 += c;
        }
    }
    return utf8;
}

ipc::MetadataText carried_text(const OIIO::ImageSpec& spec, const std::string& xmp) {
    ipc::MetadataText text;
    for (const KnownText& known : kKnown) {
        const std::string value = as_utf8(spec.get_string_attribute(known.oiio_name));
        if (!value.empty()) text.emplace_back(known.key, value);
    }
    for (auto& [key, value] : own_text(xmp)) text.emplace_back(key, as_utf8(value));
    return text;
}

double carried_dpi(const OIIO::ImageSpec& spec, const std::optional<TiffDirectory>& exif) {
    double dpi = exif ? exif->dpi() : 0;
    if (!(dpi > 0)) {
        const std::string unit = spec.get_string_attribute("ResolutionUnit");
        const double per_unit = spec.get_float_attribute("XResolution");
        dpi = unit.starts_with("in") ? per_unit : unit == "cm" ? per_unit * 2.54 : 0;
    }
    return carried_dpi(dpi);
}

double carried_dpi(double stated) {
    if (!(stated >= 1 && stated <= 1e6)) return 0;
    const double whole = std::round(stated);
    constexpr double kHalfPixelPerMetre = 0.0254 / 2;
    return std::abs(stated - whole) <= kHalfPixelPerMetre ? whole : stated;
}

std::string xmp_packet(const ipc::MetadataText& text) {
    std::string properties;
    for (const auto& [key, value] : text) {
        if (!is_own_key(key)) continue;
        properties += fmt::format("<{0}{1}>{2}</{0}{1}>\n", kOwnPrefix, key, xml_escaped(as_utf8(value)));
    }
    if (properties.empty()) return "";
    return "<?xpacket begin=\"\xef\xbb\xbf\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?>\n"
           "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\">\n"
           "<rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">\n"
           "<rdf:Description rdf:about=\"\" xmlns:dstylize=\"urn:x-dstylize:metadata:1#\">\n" +
           properties +
           "</rdf:Description>\n"
           "</rdf:RDF>\n"
           "</x:xmpmeta>\n"
           "<?xpacket end=\"r\"?>";
}

ipc::MetadataText own_text(const std::string& xmp) {
    ipc::MetadataText text;
    const std::string open = fmt::format("<{}", kOwnPrefix);
    for (std::size_t at = 0; (at = xmp.find(open, at)) != std::string::npos;) {
        at += open.size();
        const std::size_t begin = xmp.find('>', at);
        if (begin == std::string::npos) break;
        const std::string key = xmp.substr(at, begin - at);
        if (!is_own_key(key)) continue;
        const std::size_t end = xmp.find(fmt::format("</{}{}>", kOwnPrefix, key), begin);
        if (end == std::string::npos) break;
        text.emplace_back(key, xml_unescaped(std::string_view(xmp).substr(begin + 1, end - begin - 1)));
        at = end;
    }
    return text;
}

WrittenMetadata written_metadata(const ipc::MetadataText& text, double dpi) {
    WrittenMetadata metadata;
    if (dpi > 0) metadata.tags = resolution_tags(dpi);
    for (const KnownText& known : kKnown) {
        const auto entry = std::ranges::find(text, known.key, [](const auto& e) { return e.first; });
        if (entry != text.end()) metadata.tags.push_back(ascii_tag(known.tag, as_utf8(entry->second)));
    }
    metadata.xmp = xmp_packet(text);
    return metadata;
}

}  // namespace dstylize::codec
