#pragma once
#include <stdexcept>
#include <string>
#include <utility>

namespace dstylize::codec {

/// Why a picture is not decoded or encoded, and what the user can do about it.
struct Refusal : std::runtime_error {
    /// `harmful`: a decoder failed on its content, so that this process's heap is no longer trusted.
    Refusal(const std::string& problem, std::string remedy_text, bool harmful_content = false)
        : std::runtime_error(problem), remedy(std::move(remedy_text)), harmful(harmful_content) {}
    std::string remedy;
    bool harmful;
};

/// What a decoder says about damaged content.
inline Refusal damaged(const std::string& details) {
    return Refusal("is damaged" + (details.empty() ? "" : " (" + details + ")"),
                   "export it again, or take what can be read with --allow-damaged", true);
}

}  // namespace dstylize::codec
