#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace dstylize {

/// The output formats; formats.def lists them.
enum class FormatId : std::uint8_t {
#define DSTYLIZE_FORMAT(identifier, holds, alpha, ...) identifier,
#include "formats/formats.def"
#undef DSTYLIZE_FORMAT
};

/// What a file of a format holds, and so how far the pipeline has to go for it.
enum class Holds : std::uint8_t {
    picture,       ///< pixels of the rastered display list
    display_list,  ///< the drawing as vectors
    skeleton,      ///< the dendrite before it is dressed
};

struct OutputFormat {
    FormatId id;
    std::string_view name;  ///< as `--format` takes it
    Holds holds;
    bool alpha;                                    ///< whether the ground may be transparent
    std::span<const std::string_view> extensions;  ///< lower case, without the dot
};

std::span<const OutputFormat> output_formats();

/// The format whose extension the path has, upper or lower case. Throws Error(bad_usage) that names
/// the known extensions.
const OutputFormat& format_for(const std::filesystem::path& path);

/// The format of a name or an extension ("jpg", "jpeg"), as `--format` takes it. Throws likewise.
const OutputFormat& format_named(std::string_view name);

}  // namespace dstylize
