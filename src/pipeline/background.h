#pragma once
#include <filesystem>
#include <string_view>

#include "core/picture.h"

namespace dstylize {

/// What a drawing stands on, as a user says it.
struct Background {
    enum class Kind {
        style,   ///< the paper that the style names
        input,   ///< the input picture
        none,    ///< nothing: transparent
        colour,  ///< one flat colour, without grain
        file,    ///< another picture
    };
    Kind kind = Kind::style;
    Rgba colour;
    std::filesystem::path file;
};

/// "input", "none", "#rrggbb", or the name of a picture. Throws Error(bad_usage) for what begins with #
/// and is no colour.
Background parsed_background(std::string_view text);

/// The largest middle part of `picture` that has the proportions of `frame`.
Picture middle_part(const Picture& picture, Extent frame);

}  // namespace dstylize
