#include "formats/format.h"

#include <algorithm>
#include <string>

#include "core/error.h"

namespace dstylize {
namespace {

#define DSTYLIZE_FORMAT(identifier, holds, alpha, ...) \
    constexpr std::string_view identifier##_extensions[] = {__VA_ARGS__};
#include "formats/formats.def"
#undef DSTYLIZE_FORMAT

constexpr OutputFormat kFormats[] = {
#define DSTYLIZE_FORMAT(identifier, holds, alpha, ...) \
    {FormatId::identifier, #identifier, Holds::holds, alpha, identifier##_extensions},
#include "formats/formats.def"
#undef DSTYLIZE_FORMAT
};

const OutputFormat* find(std::string_view extension) {
    std::string lower(extension);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
    for (const OutputFormat& format : kFormats)
        if (std::ranges::find(format.extensions, lower) != format.extensions.end()) return &format;
    return nullptr;
}

std::string known_extensions() {
    std::string list;
    for (const OutputFormat& format : kFormats)
        for (std::string_view extension : format.extensions)
            list += (list.empty() ? "" : ", ") + std::string(extension);
    return list;
}

}  // namespace

std::span<const OutputFormat> output_formats() { return kFormats; }

const OutputFormat& format_for(const std::filesystem::path& path) {
    const std::string extension = path.extension().string();
    if (extension.size() < 2)
        throw Error(ErrorCode::bad_usage, path.string(), "no extension, so no format",
                    "end the name in one of " + known_extensions() + ", or give --format");
    const OutputFormat* format = find(std::string_view(extension).substr(1));
    if (!format)
        throw Error(ErrorCode::bad_usage, path.string(), "unknown output format '" + extension.substr(1) + "'",
                    "use one of " + known_extensions());
    return *format;
}

const OutputFormat& format_named(std::string_view name) {
    const OutputFormat* format = find(name);
    if (!format)
        throw Error(ErrorCode::bad_usage, "", "unknown output format '" + std::string(name) + "'",
                    "use one of " + known_extensions());
    return *format;
}

}  // namespace dstylize
