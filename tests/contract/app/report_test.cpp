// What the program says: reports, lists, help.
#include <nlohmann/json.hpp>
#include <sstream>

#include "contract/app/app_fixture.h"

namespace dstylize::test {
namespace {

class ReportTest : public AppTest {};

TEST_F(ReportTest, JsonTellsWhatWasDone) {
    const Outcome outcome = draw({"in.png", "out.png", "-o", "out.svg", "--json", "--seed", "4"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.err, "");
    const auto report = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(report["input"]["name"], "in.png");
    EXPECT_EQ(report["input"]["xxh128"].get<std::string>().size(), 32u);
    EXPECT_EQ(report["input"]["size_px"], nlohmann::json({96, 64}));
    EXPECT_EQ(report["style"], "ink");
    EXPECT_EQ(report["seed"], 4);
    EXPECT_EQ(report["lattice"], nlohmann::json({64, 43}));
    EXPECT_GT(report["endpoints"]["dendrite"], 10);
    EXPECT_GT(report["nodes"], report["strokes"]);
    EXPECT_EQ(report["outputs"][0]["bytes"], std::filesystem::file_size(folder_ / "out.png"));
    EXPECT_EQ(report["outputs"][1]["bytes"], std::filesystem::file_size(folder_ / "out.svg"));
    EXPECT_GE(report["steps"].size(), 5u);
    double sum = 0;
    for (const auto& step : report["steps"]) sum += step["seconds"].get<double>();
    EXPECT_LE(sum, report["seconds"].get<double>() + 1e-6);
}

TEST_F(ReportTest, JsonTellsWhyNothingWasDone) {
    const Outcome outcome = draw({"no.png", "out.png", "--json"});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1);
    const auto error = nlohmann::json::parse(outcome.out)["error"];
    EXPECT_EQ(error["exit_code"], 3);
    EXPECT_EQ(error["file"], "no.png");
}

TEST_F(ReportTest, VerboseGoesToStandardErrorAndNamesTheSteps) {
    const Outcome outcome = draw({"in.png", "out.png", "--verbose"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.out, "");
    for (const char* word : {"in.png", "reading", "fields", "dendrite: paths", "endpoints", "strokes", "out.png"})
        EXPECT_NE(outcome.err.find(word), std::string::npos) << word;
}

TEST_F(ReportTest, DryRunChecksAndWritesNothing) {
    const auto before = folder_.names();
    const Outcome outcome = draw({"in.png", "out.png", "--dry-run", "--size", "300", "--recipe", "r.toml"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("out.png as png, 300 x 200"), std::string::npos) << outcome.out;
    EXPECT_EQ(folder_.names(), before);
    expect_error(draw({"no.png", "out.png", "--dry-run"}), 3, {"no.png"});
}

TEST_F(ReportTest, StylesAreListedAndDescribed) {
    const Outcome list = run({"styles"});
    expect_done(list);
    for (const char* style : {"vine", "ink"}) {
        EXPECT_NE(list.out.find(style), std::string::npos);
        const Outcome one = run({"styles", style});
        expect_done(one);
        for (const char* key : {"detail", "16 … 16384", "neighbours", "narrowest"})
            EXPECT_NE(one.out.find(key), std::string::npos) << style << " " << key;
    }
    const Outcome fields = run({"styles", "--fields"});
    for (const char* field : {"importance", "tone", "white_noise", "flow"})
        EXPECT_NE(fields.out.find(field), std::string::npos) << field;
}

TEST_F(ReportTest, VersionAndStylesStartNoCodec) {
    // A copy of the program with no codec beside it: only what needs none still works.
    TempFolder alone;
    std::filesystem::copy_file(DSTYLIZE_PROGRAM, alone / "dstylize");
    for (const Words& words : {Words{"--version"}, Words{"styles"}, Words{"styles", "vine"}, Words{"--help"}}) {
        Words command{(alone / "dstylize").string()};
        command.insert(command.end(), words.begin(), words.end());
        Process process(command, folder_.path());
        EXPECT_EQ(process.wait(), 0) << process.err();
        EXPECT_NE(process.out(), "");
    }
}

TEST_F(ReportTest, HelpFitsAScreen) {
    const Outcome help = run({"--help"});
    expect_done(help);
    EXPECT_LE(std::count(help.out.begin(), help.out.end(), '\n'), 27);
    for (const Words& words :
         {Words{"--help"}, Words{"--help-all"}, Words{"replay", "--help"}, Words{"styles", "--help"},
          Words{"sbatch", "--help"}, Words{"merge-reports", "--help"}}) {
        std::istringstream lines(run(words).out);
        for (std::string line; std::getline(lines, line);) {
            const auto columns = std::count_if(line.begin(), line.end(), [](unsigned char c) { return c >> 6 != 2; });
            EXPECT_LE(columns, 80) << line;
        }
    }
}

TEST_F(ReportTest, AControlCharacterInANameStaysOneLine) {
    expect_error(draw({"no\nsuch\tpicture.png", "out.png"}), 3, {"no?such?picture.png"});
}

TEST_F(ReportTest, SaysWhatTheDecoderWasKeptFrom) {
    EXPECT_NE(draw({"in.png", "out.png", "--verbose"}).err.find("the decoder was kept from"), std::string::npos);
}

TEST_F(ReportTest, AKernelThatConfinesNothingIsNamedAndNoHindrance) {
    Process process({DSTYLIZE_PROBE, "--old-kernel", DSTYLIZE_PROGRAM, "in.png", "out.png", "--style", "ink",
                     "--detail", "64", "--verbose"},
                    folder_.path());
    EXPECT_EQ(process.wait(), 0) << process.err();
    EXPECT_NE(process.err().find("this kernel confines no process"), std::string::npos) << process.err();
    EXPECT_EQ(read_picture(folder_ / "out.png").picture.extent(), kSize);
}

}  // namespace
}  // namespace dstylize::test
