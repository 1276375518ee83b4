#include "pipeline/folder_listing.h"

#include <fnmatch.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "core/error.h"

namespace dstylize {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 14> kExtensions{".png", ".jpg", ".jpeg", ".tif", ".tiff", ".webp", ".bmp",
                                                       ".gif", ".pnm", ".ppm",  ".pgm", ".pbm",  ".hdr",  ".exr"};

bool is_wanted(const fs::path& relative, const std::vector<std::string>& patterns) {
    if (patterns.empty()) {
        std::string extension = relative.extension().string();
        std::transform(extension.begin(), extension.end(), extension.begin(),
                       [](unsigned char c) { return c < 128 ? char(std::tolower(c)) : char(c); });
        return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
    }
    return std::any_of(patterns.begin(), patterns.end(), [&](const std::string& pattern) {
        const bool of_path = pattern.find('/') != std::string::npos;
        return ::fnmatch(pattern.c_str(), (of_path ? relative : relative.filename()).c_str(), 0) == 0;
    });
}

class Listing {
  public:
    Listing(const fs::path& folder, const std::vector<std::string>& patterns, const fs::path& leave_out)
        : folder_(folder), patterns_(patterns), leave_out_(leave_out) {}

    std::vector<fs::path> pictures() && {
        list("");
        std::sort(found_.begin(), found_.end(),
                  [](const fs::path& a, const fs::path& b) { return a.native() < b.native(); });
        return std::move(found_);
    }

  private:
    void list(const fs::path& relative) {
        std::error_code error;
        for (fs::directory_iterator at(folder_ / relative, error), end; !error && at != end; at.increment(error)) {
            const fs::path name = at->path().filename();
            if (name.native().starts_with('.')) continue;
            std::error_code ignored;
            if (at->is_directory(ignored)) {
                if (!at->is_symlink(ignored) && !fs::equivalent(at->path(), leave_out_, ignored)) list(relative / name);
            } else if (at->is_regular_file(ignored) && is_wanted(relative / name, patterns_)) {
                found_.push_back(relative / name);
            }
        }
        if (error)
            throw Error(ErrorCode::cannot_read, (folder_ / relative).string(),
                        "the folder cannot be listed (" + error.message() + ")", "check its permissions");
    }

    const fs::path& folder_;
    const std::vector<std::string>& patterns_;
    const fs::path& leave_out_;
    std::vector<fs::path> found_;
};

}  // namespace

std::vector<fs::path> pictures_in(const fs::path& folder, const std::vector<std::string>& patterns,
                                  const fs::path& leave_out) {
    return Listing(folder, patterns, leave_out).pictures();
}

}  // namespace dstylize
