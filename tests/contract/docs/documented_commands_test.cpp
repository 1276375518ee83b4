// What the documents tell people to type works: every indented `dstylize …` line of the README and the
// gallery is run, on a sample in the place of a picture that is not ours, at a small detail.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "support/process.h"

namespace dstylize {
namespace {

namespace fs = std::filesystem;

std::vector<std::vector<std::string>> documented_commands(const std::string& document) {
    std::ifstream in(fs::path(DSTYLIZE_SOURCE_DIR) / document);
    std::vector<std::vector<std::string>> out;
    for (std::string line; std::getline(in, line);) {
        const bool direct = line.starts_with("    dstylize "), by_dev = line.starts_with("    ./dev run ");
        if (!direct && !by_dev) continue;
        std::istringstream words(line.substr(direct ? 13 : 14));
        out.emplace_back();
        for (std::string word; words >> word;) out.back().push_back(word);
    }
    return out;
}

/// A picture's name in a document: ours as it is, anybody else's replaced by a sample.
std::string on_this_machine(const std::string& word) {
    const fs::path path = fs::path(DSTYLIZE_SOURCE_DIR) / word;
    return fs::exists(path) ? path.string() : (fs::path(DSTYLIZE_SOURCE_DIR) / "samples/portrait.png").string();
}

class Documented : public ::testing::TestWithParam<std::string> {};

TEST_P(Documented, EveryCommandDraws) {
    const auto commands = documented_commands(GetParam());
    ASSERT_FALSE(commands.empty());
    for (std::vector<std::string> words : commands) {
        SCOPED_TRACE(::testing::PrintToString(words));
        const test::TempFolder folder;
        // `write` needs no picture: what it names is ours.
        for (std::size_t k = 0; k < words.size(); ++k)
            if (words[k].starts_with("samples/") || (k == 0 && words[0] != "write"))
                words[k] = on_this_machine(words[k]);
        words.insert(words.end(), {"--detail", "96", "--size", "120"});
        const test::Outcome outcome = test::dstylize(words, folder.path());
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(folder.names().size(), 1u) << "one output";
    }
}
INSTANTIATE_TEST_SUITE_P(Documents, Documented, ::testing::Values("README.md", "docs/gallery/README.md"),
                         [](const auto& row) { return std::string(row.index == 0 ? "Readme" : "Gallery"); });

}  // namespace
}  // namespace dstylize
