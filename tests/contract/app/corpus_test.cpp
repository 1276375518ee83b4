// Whole pictures of every format are drawn upright; damaged and greedy ones are refused by name, or drawn, and never
// bring anything down. (Bars R1, R2, R5 and R6 of docs/reliability.md; ./dev campaign corpus has the long part.)
#include <nlohmann/json.hpp>

#include <fstream>
#include <sstream>

#include "contract/app/app_fixture.h"
#include "core/error.h"
#include "corpus/sound.h"
#include "support/sanitized.h"

namespace dstylize::test {
namespace {

namespace fs = std::filesystem;

class CorpusTest : public AppTest {
  protected:
    const std::vector<CorpusFile> sound_ = sound_pictures(codec());

    void put(const CorpusFile& file, const fs::path& folder) const {
        fs::create_directories(folder_ / folder.string());
        write_file(folder_.path() / folder / file.name, file.bytes);
    }
    nlohmann::json report() const { return nlohmann::json::parse(std::ifstream(folder_ / "out/report.json")); }
};

TEST_F(CorpusTest, EveryWholePictureIsReadAtItsSize) {
    for (const CorpusFile& file : sound_)
        EXPECT_EQ(codec().decode(file.bytes, file.name).picture.extent(), file.extent);
}

TEST_F(CorpusTest, DamageIsRefusedInOneLineOrRead) {
    constexpr std::uint64_t kFiles = fewer_if_sanitized(1500);
    std::size_t refused = 0;
    for (std::uint64_t n = 0; n < kFiles; ++n) {
        const CorpusFile file = damaged_picture(sound_, n);
        try {
            codec().decode(file.bytes, file.name);
        } catch (const Error& error) {
            ++refused;
            EXPECT_EQ(error.code(), ErrorCode::cannot_read) << file.name;
            EXPECT_EQ(error.file(), file.name);
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        }
    }
    EXPECT_GT(refused, kFiles / 2);
    EXPECT_LT(refused, kFiles) << "no damage was harmless: is anything read at all?";
}

TEST_F(CorpusTest, AFolderFailsExactlyOnWhatIsDamaged) {
    for (const CorpusFile& file : sound_) put(file, "photos");
    std::set<std::string> broken;
    for (std::uint64_t n = 0; broken.size() < 8; ++n) {
        const CorpusFile file = damaged_picture(sound_, n);
        try {
            codec().decode(file.bytes, file.name);
        } catch (const Error&) {
            put(file, "photos");
            broken.insert(file.name);
        }
    }
    const Outcome outcome = draw({"photos", "out"});
    EXPECT_EQ(outcome.exit_code, 5);
    std::set<std::string> named;
    std::istringstream lines(outcome.err);
    for (std::string line; std::getline(lines, line);) {
        ASSERT_TRUE(line.starts_with("dstylize: photos/")) << line;
        named.insert(line.substr(17, line.find(": ", 17) - 17));
    }
    EXPECT_EQ(named, broken);
    const auto whole = report();
    EXPECT_EQ(whole["pictures"].size(), sound_.size() + broken.size());
    for (const auto& picture : whole["pictures"]) {
        const std::string input = picture.at("input"), result = picture.at("results").at(0);
        EXPECT_EQ(picture.at("state"), broken.contains(input) ? "failed" : "done") << input;
        EXPECT_EQ(fs::exists(folder_ / ("out/" + result)), !broken.contains(input)) << result;
    }
}

TEST_F(CorpusTest, GreedIsRefusedWithinTheMemoryThatIsGranted) {
    for (const CorpusFile& file : greedy_pictures()) {
        SCOPED_TRACE(file.name);
        put(file, "greedy");
        const auto before = folder_.names();
        const Outcome outcome = draw({"greedy/" + file.name, "out.png", "--max-memory", "256M"});
        if (outcome.exit_code == 0) {
            expect_done(outcome);
            fs::remove(folder_ / "out.png");
        } else {
            expect_error(outcome, 3, {file.name});
        }
        EXPECT_EQ(folder_.names(), before);
    }
}

}  // namespace
}  // namespace dstylize::test
