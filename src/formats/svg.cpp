// Text is appended piece by piece with our own number writer: 1/100 pixel, no exponent, no locale,
// and as few characters as the grammar allows, since a drawing is some hundred thousand numbers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

#include "formats/detail_vector.h"

namespace dstylize {
namespace {

std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : clean_text(text)) {
        switch (c) {
            case '&': out += "&amp;"; break;
            case '<': out += "&lt;"; break;
            case '>': out += "&gt;"; break;
            case '"': out += "&quot;"; break;
            case '\r': out += "&#13;"; break;  // a parser would read a bare one as a line feed
            default: out += c;
        }
    }
    return out;
}

int byte(float v) { return int(std::clamp(v, 0.0f, 1.0f) * 255.0f + 0.5f); }

std::string hex(Rgba c) { return fmt::format("#{:02x}{:02x}{:02x}", byte(c.r), byte(c.g), byte(c.b)); }

/// A number that is a multiple of 1/100, without needless digits.
std::string decimal(double value) {
    std::string text = fmt::format("{:.2f}", value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
}

void append_base64(std::string& out, std::span<const std::byte> bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t here = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < here ? std::uint32_t(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) out += k <= here ? kDigits[group >> (18 - 6 * k) & 63] : '=';
    }
}

std::string_view css_name(Mixing mixing) {
    switch (mixing) {
        case Mixing::over: return "normal";
        case Mixing::multiply: return "multiply";
        case Mixing::screen: return "screen";
        case Mixing::soft_light: return "soft-light";
    }
    return "normal";
}

/// Path data in relative coordinates. Differences are taken between rounded positions, so that
/// rounding errors do not add up along a path.
class PathWriter {
  public:
    explicit PathWriter(std::string& out) : out_(out) {}

    void write(const CubicPath& path) {
        x_ = y_ = 0;
        command('M');
        point(path.start);
        move_to(path.start);
        for (const CubicPiece& piece : path.pieces) {
            if (piece.straight) {
                if (!moves(piece.end)) continue;
                command('l');
            } else {
                command('c');
                point(piece.control1);
                point(piece.control2);
            }
            point(piece.end);
            move_to(piece.end);
        }
        out_ += 'z';
    }

  private:
    static int hundredths(float v) { return int(std::lround(v * 100)); }
    bool moves(Vec2f p) const { return hundredths(p.x) != x_ || hundredths(p.y) != y_; }
    void move_to(Vec2f p) {
        x_ = hundredths(p.x);
        y_ = hundredths(p.y);
    }
    void command(char c) {
        if (c != command_) out_ += c;
        separated_ = c != command_;
        command_ = c;
    }
    void point(Vec2f p) {
        number(hundredths(p.x) - x_);
        number(hundredths(p.y) - y_);
    }
    void number(int n) {
        if (n < 0)
            out_ += '-';
        else if (!separated_)
            out_ += ' ';
        separated_ = false;
        const unsigned size = unsigned(std::abs(n)), whole = size / 100, part = size % 100;
        if (whole > 0 || part == 0) out_ += fmt::format_int(whole).c_str();
        if (part == 0) return;
        out_ += '.';
        out_ += char('0' + part / 10);
        if (part % 10 != 0) out_ += char('0' + part % 10);
    }

    std::string& out_;
    int x_ = 0, y_ = 0;
    char command_ = 0;
    bool separated_ = true;
};

class SvgWriter {
  public:
    std::string document(const DisplayList& list, const DocumentInfo& info) {
        head(list, info);
        metadata(info);
        paper(list, info);
        visit_layers(
            list, shape_tolerance_px(list),
            [&] {
                open_group("drawing", "drawing", fmt::format(" style=\"mix-blend-mode:{}\"", css_name(list.mixing)));
            },
            [&](const ShapeLayer& shapes) { layer(shapes); }, [&] { out_ += "</g>\n"; });
        if (!info.cover_png.empty()) locked_picture("foreground", list, info.cover_png);
        out_ += "</svg>\n";
        return std::move(out_);
    }

  private:
    void head(const DisplayList& list, const DocumentInfo& info) {
        const PageSize page = page_size(list, info);
        const bool in_px = info.width_mm <= 0 && info.height_mm <= 0;
        const std::string width = in_px ? decimal(list.width_px) : decimal(page.width_mm) + "mm";
        const std::string height = in_px ? decimal(list.height_px) : decimal(page.height_mm) + "mm";
        out_ += fmt::format(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<svg xmlns=\"http://www.w3.org/2000/svg\"\n"
            "     xmlns:xlink=\"http://www.w3.org/1999/xlink\"\n"
            "     xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\"\n"
            "     xmlns:sodipodi=\"http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd\"\n"
            "     xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\"\n"
            "     xmlns:dc=\"http://purl.org/dc/elements/1.1/\" xmlns:d=\"urn:dstylize\"\n"
            "     version=\"1.1\" width=\"{}\" height=\"{}\" viewBox=\"0 0 {} {}\" preserveAspectRatio=\"none\">\n",
            width, height, decimal(list.width_px), decimal(list.height_px));
    }

    void metadata(const DocumentInfo& info) {
        if (!info.title.empty()) out_ += "<title>" + escaped(info.title) + "</title>\n";
        out_ += "<metadata>\n<rdf:RDF><rdf:Description rdf:about=\"\"><dc:format>image/svg+xml</dc:format>";
        const auto element = [&](const char* name, std::string_view text) {
            if (!text.empty()) out_ += fmt::format("<dc:{0}>{1}</dc:{0}>", name, escaped(text));
        };
        element("title", info.title);
        element("creator", text_of(info, "author"));
        element("rights", text_of(info, "copyright"));
        out_ += "</rdf:Description></rdf:RDF>\n";
        for (const auto& [key, text] : info.text)
            out_ += fmt::format("<d:text key=\"{}\">{}</d:text>\n", escaped(key), escaped(text));
        out_ += "</metadata>\n";
    }

    void paper(const DisplayList& list, const DocumentInfo& info) {
        if (list.paper.picture ? info.paper_png.empty() : list.paper.colour.a <= 0) return;
        if (list.paper.picture) {
            locked_picture("paper", list, info.paper_png);
            return;
        }
        open_group("paper", "paper", kLocked);
        out_ += fmt::format("<rect width=\"{}\" height=\"{}\"{}/>\n</g>\n", decimal(list.width_px),
                            decimal(list.height_px), paint(list.paper.colour));
    }

    void locked_picture(std::string_view name, const DisplayList& list, std::span<const std::byte> png) {
        open_group(name, name, kLocked);
        out_ += fmt::format("<image width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" ", decimal(list.width_px),
                            decimal(list.height_px));
        out_ += "xlink:href=\"data:image/png;base64,";
        append_base64(out_, png);
        out_ += "\"/>\n</g>\n";
    }

    void layer(const ShapeLayer& layer) {
        if (layer.groups.empty()) return;
        std::string attributes = layer.one_colour ? paint(layer.groups[0].shapes[0].colour) : "";
        if (layer.opacity < 1) attributes += opacity("opacity", layer.opacity);
        if (layer.light) attributes += " style=\"mix-blend-mode:screen\"";
        open_group(layer.name, layer.name, attributes);
        for (const ShapeGroup& group : layer.groups) {
            const std::string label =
                group.strokes ? fmt::format("stage {} order {}", group.stage + 1, group.order) : "shapes";
            open_group(layer.name + " " + label, label, "");
            for (const Shape& shape : group.shapes) {
                out_ += "<path";
                if (!layer.one_colour) out_ += paint(shape.colour);
                out_ += " d=\"";
                PathWriter(out_).write(shape.path);
                out_ += "\"/>\n";
            }
            out_ += "</g>\n";
        }
        out_ += "</g>\n";
    }

    void open_group(std::string_view id, std::string_view label, std::string_view attributes) {
        out_ += fmt::format("<g id=\"{}\" inkscape:groupmode=\"layer\" inkscape:label=\"{}\"{}>\n", unique_id(id),
                            escaped(label), attributes);
    }

    static std::string paint(Rgba c) {
        std::string text = fmt::format(" fill=\"{}\"", hex(c));
        if (c.a < 1) text += opacity("fill-opacity", c.a);
        return text;
    }
    static std::string opacity(const char* name, float value) {
        return fmt::format(" {}=\"{:.3f}\"", name, std::clamp(value, 0.0f, 1.0f));
    }

    /// An XML name made of the text, different from all before.
    std::string unique_id(std::string_view text) {
        std::string id;
        for (const char c : text) {
            const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
            id += plain ? c : '-';
        }
        if (id.empty() || id[0] == '-' || (id[0] >= '0' && id[0] <= '9')) id.insert(id.begin(), 'g');
        std::string unique = id;
        for (int n = 2; !ids_.insert(unique).second; ++n) unique = fmt::format("{}-{}", id, n);
        return unique;
    }

    static constexpr std::string_view kLocked = " sodipodi:insensitive=\"true\"";

    std::string out_;
    std::set<std::string> ids_;
};

}  // namespace

std::string svg_document(const DisplayList& list, const DocumentInfo& info) { return SvgWriter().document(list, info); }

}  // namespace dstylize
