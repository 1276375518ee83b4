#include "pipeline/describe.h"

#include <fmt/format.h>

#include "core/error.h"
#include "importance/fields.h"
#include "pipeline/style_file.h"

namespace dstylize {

std::string styles_description(const std::filesystem::path& user_folder) {
    std::string out;
    for (const BuiltinStyle& builtin : builtin_styles())
        out += fmt::format("{:<12} {}\n", builtin.name, load_style(std::string(builtin.name)).summary);
    for (const std::string& name : user_style_names(user_folder)) {
        std::string summary;
        try {
            summary = load_style(name, {}, user_folder).summary;
        } catch (const Error& error) {
            summary = error.what();
        }
        out += fmt::format("{:<12} {}\n", name, summary);
    }
    return out;
}

std::string fields_description() {
    std::string out;
    for (const std::string_view name : Fields::names()) out += fmt::format("{:<14} {}\n", name, Fields::meaning(name));
    out += fmt::format("{:<14} {}\n", "flow",
                       "direction (hue) and coherence of the picture's structures; only for --show");
    out += "--show also takes weights, endpoints, distance, owners and tree, each as NAME or NAME:STAGE.\n";
    return out;
}

}  // namespace dstylize
