#include "pipeline/manifest.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <span>

#include "core/error.h"
#include "formats/files.h"
#include "pipeline/content_hash.h"

namespace dstylize {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kHeadLine = "# dstylize manifest 1, pictures: ";

std::string escaped(const std::string& path) {
    std::string out;
    for (const char c : path) out += c == '\\' ? "\\\\" : c == '\n' ? "\\n" : std::string(1, c);
    return out;
}

class Reader {
  public:
    Reader(std::string_view text, const std::string& name) : text_(text), name_(name) {}

    std::vector<std::string> pictures() && {
        const std::string head(line());
        std::vector<std::string> out;
        std::vector<std::string_view> lines;
        while (!text_.empty()) {
            lines.push_back(line());
            out.push_back(path(lines.back()));
        }
        if (head != fmt::format("{}{}", kHeadLine, out.size())) {
            if (!head.starts_with(kHeadLine)) refuse("is no manifest");
            refuse(fmt::format("is not whole: it lists {} pictures", out.size()));
        }
        std::sort(lines.begin(), lines.end());
        const auto twice = std::adjacent_find(lines.begin(), lines.end());
        if (twice != lines.end()) refuse(fmt::format("names {} twice", *twice));
        return out;
    }

  private:
    [[noreturn]] void refuse(const std::string& problem) const {
        throw Error(ErrorCode::cannot_read, name_, problem, "remove it, and it is made anew");
    }

    std::string_view line() {
        const std::size_t end = text_.find('\n');
        if (end == std::string_view::npos) refuse(text_.empty() ? "is no manifest" : "is not whole");
        const std::string_view out = text_.substr(0, end);
        text_.remove_prefix(end + 1);
        return out;
    }

    std::string path(std::string_view escaped) const {
        std::string out;
        for (std::size_t k = 0; k < escaped.size(); ++k) {
            if (escaped[k] != '\\') {
                out += escaped[k];
                continue;
            }
            const char c = ++k < escaped.size() ? escaped[k] : ' ';
            if (c != '\\' && c != 'n') refuse("has a line that is no path: " + std::string(escaped));
            out += c == 'n' ? '\n' : c;
        }
        const fs::path path = out;
        const bool leads_out = path.is_absolute() || std::find(path.begin(), path.end(), "..") != path.end();
        if (path.empty() || leads_out || !path.has_filename() || path.lexically_normal().native() != out)
            refuse("has a line that is no path from the folder: " + std::string(escaped));
        return out;
    }

    std::string_view text_;
    const std::string& name_;
};

}  // namespace

std::string manifest_text(const std::vector<std::string>& pictures) {
    std::string out = fmt::format("{}{}\n", kHeadLine, pictures.size());
    for (const std::string& picture : pictures) out += escaped(picture) + "\n";
    return out;
}

Manifest parsed_manifest(std::string_view text, const std::string& name) {
    return {Reader(text, name).pictures(), content_hash(std::as_bytes(std::span(text)))};
}

Manifest frozen_manifest(const fs::path& file, const std::function<std::vector<std::string>()>& list) {
    std::error_code ignored;
    if (!fs::exists(file, ignored)) {
        const std::string text = manifest_text(list());
        create_file_atomically(file, std::as_bytes(std::span(text)));
    }
    const std::vector<std::byte> bytes = read_file(file, std::numeric_limits<std::uint64_t>::max());
    return parsed_manifest({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file.string());
}

}  // namespace dstylize
