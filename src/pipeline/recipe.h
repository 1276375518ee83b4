#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formats/picture_codec.h"
#include "pipeline/writing.h"

namespace dstylize {

/// A file that a drawing was made from: its name as it was given, and its content_hash.
struct FileMark {
    std::string name, xxh128;
};

/// All that is needed to make a drawing again, beside the input itself. As text it is a style file with
/// one more table, [recipe]; every output carries that text.
struct Recipe {
    std::string program;  ///< "dstylize 0.1.0"
    std::uint64_t seed = 1;
    FileMark input;  ///< no name: plain paper
    std::optional<FileMark> importance, mask, endpoints, background_file;
    bool importance_replaces = false;
    bool no_picture = false;
    std::vector<std::string> roots;  ///< as --root takes them
    std::string background;          ///< as --background takes it; empty: the style's paper, or background_file
    std::string place;               ///< as --place takes it; empty: the drawing's frame is the output's
    std::optional<Writing> writing;  ///< words that were the mask
    std::string size;                ///< as --size takes it; empty: the input's
    std::string style_toml;          ///< the whole style
};

/// The text; it reads back as written.
std::string recipe_toml(const Recipe& recipe);

/// The recipe in such a text; `style_toml` is then the whole of it. Throws Error(cannot_read) when there
/// is no [recipe] or it is malformed.
Recipe parse_recipe(std::string_view toml, const std::string& origin);

/// The recipe's text in an output of ours (picture, SVG, PDF, JSON) or in a recipe file.
/// Throws Error(cannot_read) when it has none.
std::string recipe_in_file(std::span<const std::byte> file, const std::string& name, PictureCodec& codec);

}  // namespace dstylize
