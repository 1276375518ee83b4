#include "pipeline/result_names.h"

#include <algorithm>
#include <map>

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

void check(const ResultNaming& naming) {
    if (naming.name.find("{stem}") == std::string::npos)
        refuse(naming, "gives all pictures one name", "let {stem} be in it");
    const fs::path name = filled(naming, "stem");
    if (name.is_absolute() || !name.has_filename() || std::find(name.begin(), name.end(), "..") != name.end())
        refuse(naming, "leads out of the folder of the drawings", "write a name, or a path from there");
}

}  // namespace

std::vector<std::vector<fs::path>> result_names(const std::vector<fs::path>& pictures, const ResultNaming& naming) {
    check(naming);
    const auto named = [&](const fs::path& picture, const fs::path& stem) {
        return (picture.parent_path() / filled(naming, stem.string())).lexically_normal();
    };
    std::map<fs::path, int> times;
    const auto& extensions = naming.extensions;
    if (std::find(extensions.begin(), extensions.end(), "json") != extensions.end()) ++times["report"];
    for (const fs::path& picture : pictures) ++times[named(picture, picture.stem())];
    std::vector<std::vector<fs::path>> out;
    for (const fs::path& picture : pictures) {
        fs::path plain = named(picture, picture.stem());
        if (times[plain] > 1) plain = named(picture, picture.filename());
        out.emplace_back();
        for (const std::string& extension : extensions) out.back().emplace_back(plain.string() + "." + extension);
    }
    return out;
}

}  // namespace dstylize
