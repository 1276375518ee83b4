// The manual page and the completions know the options that the program has, no more and no fewer.
#include <regex>
#include <set>

#include "contract/app/app_fixture.h"

namespace dstylize::test {
namespace {

std::set<std::string> matches(const std::string& text, const std::string& pattern, const std::string& prefix = "") {
    const std::regex regex(pattern);
    std::set<std::string> out;
    for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it)
        out.insert(prefix + (*it)[1].str());
    return out;
}

std::string repository_file(const std::string& path) {
    std::string text = file_bytes(std::filesystem::path(DSTYLIZE_SOURCE_DIR) / path);
    EXPECT_FALSE(text.empty()) << path;
    return text;
}

class DocumentsTest : public AppTest {
  protected:
    std::set<std::string> options() const {
        return matches(run({"--help-all"}).out + run({"write", "--help"}).out + run({"replay", "--help"}).out +
                           run({"styles", "--help"}).out + run({"sbatch", "--help"}).out +
                           run({"merge-reports", "--help"}).out,
                       "[\\s,](--?[a-z][a-z-]*)(?=[, ])");
    }
};

TEST_F(DocumentsTest, OptionsAreFound) {
    const auto found = options();
    for (const char* option : {"--style", "-s", "--help", "-h", "--no-recipe", "--fields", "--max-memory"})
        EXPECT_TRUE(found.contains(option)) << option;
    EXPECT_GT(found.size(), 30u);
}

TEST_F(DocumentsTest, TheManualPageDescribesEveryOption) {
    const std::string page = repository_file("docs/dstylize.1");
    std::set<std::string> described;
    const std::regex line("(?:^|\\n)\\.It Fl ([^\\n]*)");
    for (std::sregex_iterator it(page.begin(), page.end(), line), end; it != end; ++it) {
        const std::string words = (*it)[1].str();
        for (const std::string& name : matches(words, "(?:^|, )(-?[a-z][a-z-]*)", "-")) described.insert(name);
    }
    EXPECT_EQ(described, options());
}

TEST_F(DocumentsTest, BashCompletesEveryOption) {
    const std::string text = repository_file("completions/dstylize.bash");
    std::set<std::string> found;
    for (const std::string& list : matches(text, "(?:output|draw|draw_words|draw_slurm|words)=['\"]([^'\"]*)['\"]"))
        found.merge(matches(" " + list + " ", "\\s(--?[a-z][a-z-]*)(?=\\s)"));
    EXPECT_EQ(found, options());
}

TEST_F(DocumentsTest, ZshCompletesEveryOption) {
    EXPECT_EQ(matches(repository_file("completions/_dstylize"), "['{,)*](--?[a-z][a-z-]*)(?=[\\[},])"), options());
}

TEST_F(DocumentsTest, FishCompletesEveryOption) {
    const std::string text = repository_file("completions/dstylize.fish");
    auto found = matches(text, " -l ([a-z-]+)", "--");
    found.merge(matches(text, " -s ([a-z])", "-"));
    EXPECT_EQ(found, options());
}

}  // namespace
}  // namespace dstylize::test
