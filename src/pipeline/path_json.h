#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace dstylize {

/// A path in JSON: a text or, as names of files need not be UTF-8 and JSON must be, a list of its bytes.
template <class Json>
Json path_json(const std::string& path) {
    Json text = path;
    try {
        static_cast<void>(text.dump());
        return text;
    } catch (const nlohmann::json::exception&) {
        return std::vector<unsigned char>(path.begin(), path.end());
    }
}

/// The path again. Throws nlohmann::json::exception for what is neither.
template <class Json>
std::string path_from_json(const Json& json) {
    if (json.is_string()) return json.template get<std::string>();
    const auto bytes = json.template get<std::vector<unsigned char>>();
    return {bytes.begin(), bytes.end()};
}

}  // namespace dstylize
