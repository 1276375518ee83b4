#include "pipeline/result_names.h"

#include <algorithm>
#include <filesystem>

#include "core/error.h"

namespace dstylize {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const ResultNaming& naming, const std::string& problem, const std::string& remedy) {
    throw Error(ErrorCode::bad_usage, "--name " + naming.name, problem, remedy);
}

std::string filled(const ResultNaming& naming, const std::string& stem) {
    std::string out;
    for (std::size_t at = 0; at < naming.name.size();) {
        const std::size_t open = std::min(naming.name.find('{', at), naming.name.size());
        out += naming.name.substr(at, open - at);
        if (open == naming.name.size()) break;
        const std::size_t close = naming.name.find('}', open);
        const std::string field = naming.name.substr(open, close == std::string::npos ? close : close - open + 1);
        if (field == "{stem}")
            out += stem;
        else if (field == "{style}")
            out += naming.style;
        else if (field == "{seed}")
            out += std::to_string(naming.seed);
        else
            refuse(naming, field + " is no field", "write {stem}, {style} or {seed}");
        at = close + 1;
    }
    return out;
}

}  // namespace

void check_naming(const ResultNaming& naming) {
    if (naming.name.find("{stem}") == std::string::npos)
        refuse(naming, "gives all pictures one name", "let {stem} be in it");
    const fs::path name = filled(naming, "stem");
    if (name.is_absolute() || !name.has_filename() || std::find(name.begin(), name.end(), "..") != name.end())
        refuse(naming, "leads out of the folder of the drawings", "write a name, or a path from there");
}

namespace {

/// The result's path but for its extension.
std::string named(const ResultNaming& naming, const fs::path& picture, const fs::path& stem) {
    return (picture.parent_path() / filled(naming, stem.string())).lexically_normal().string();
}

}  // namespace

ResultNames::ResultNames(ResultNaming naming, const std::vector<std::string>& all_pictures)
    : naming_(std::move(naming)) {
    check_naming(naming_);
    std::vector<std::string> names;
    names.reserve(all_pictures.size() + 1);
    const auto& extensions = naming_.extensions;
    if (std::find(extensions.begin(), extensions.end(), "json") != extensions.end()) names.emplace_back("report");
    for (const fs::path picture : all_pictures) names.push_back(named(naming_, picture, picture.stem()));
    std::sort(names.begin(), names.end());
    for (auto at = names.begin(); (at = std::adjacent_find(at, names.end())) != names.end();) {
        shared_.push_back(*at);
        at = std::upper_bound(at, names.end(), shared_.back());
    }
}

std::vector<std::string> ResultNames::of(const std::string& picture) const {
    const fs::path path = picture;
    std::string name = named(naming_, path, path.stem());
    if (std::binary_search(shared_.begin(), shared_.end(), name)) name = named(naming_, path, path.filename());
    std::vector<std::string> out;
    for (const std::string& extension : naming_.extensions) out.push_back(name + "." + extension);
    return out;
}

}  // namespace dstylize
