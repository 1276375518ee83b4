// toml++ from its headers alone: its compiled library reads and writes numbers through streams, and a stream takes an
// allocation that fails for the end of a number.
#pragma once

#define TOML_HEADER_ONLY 1
#define TOML_FLOAT_CHARCONV 1
#include <fmt/format.h>
#include <toml++/toml.h>

#include <sstream>
#include <string>
#include <string_view>

#include "core/error.h"

namespace dstylize {

/// The tree of a TOML text. \param origin its file, for the error. \throws Error with `code`, the place and `remedy`.
inline toml::table parsed_toml(std::string_view text, const std::string& origin, ErrorCode code, const char* remedy) {
    // From a stream: from a text, toml++ would copy the origin's name in a function that may not throw.
    std::istringstream stream{std::string(text)};
    try {
        return toml::parse(stream, origin);
    } catch (const toml::parse_error& e) {
        throw Error(code, fmt::format("{}:{}:{}", origin, e.source().begin.line, e.source().begin.column),
                    std::string(e.description()), remedy);
    }
}

}  // namespace dstylize
