#pragma once
#include <map>
#include <nlohmann/json.hpp>

#include "contract/app/app_fixture.h"

namespace dstylize::test {

/// A folder `photos` of three pictures and a text.
class FolderTest : public AppTest {
  protected:
    FolderTest() {
        namespace fs = std::filesystem;
        fs::create_directories(folder_ / "photos/sea/deep");
        write_png(folder_ / "photos/a.png", scene(kSize));
        write_png(folder_ / "photos/sea/b.png", scene({64, 80}));
        write_png(folder_ / "photos/sea/deep/c d&.png", flat({40, 40}, {90, 120, 200, 255}));
        write_file(folder_ / "photos/notes.txt", std::string_view("no picture"));
    }
    /// State of every picture of the last run.
    std::map<std::string, std::string> states(const std::string& out = "out") const {
        std::map<std::string, std::string> states;
        const auto tree = nlohmann::json::parse(file_bytes(folder_ / out / "report.json"));
        for (const auto& row : tree["pictures"]) states[row["input"]] = row["state"];
        return states;
    }
    Outcome draw_all(Words more = {}) const {
        Words words{"photos", "out"};
        words.insert(words.end(), more.begin(), more.end());
        return draw(words);
    }
};

/// Names and contents of all results.
inline std::map<std::string, std::string> results(const std::filesystem::path& out) {
    std::map<std::string, std::string> files;
    if (!std::filesystem::exists(out)) return files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(out))
        if (entry.is_regular_file() && entry.path().extension() == ".png")
            files[std::filesystem::relative(entry.path(), out)] = file_bytes(entry.path());
    return files;
}

}  // namespace dstylize::test
