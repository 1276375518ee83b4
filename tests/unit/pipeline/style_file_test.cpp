#include "pipeline/style_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/error.h"

namespace dstylize {
namespace {

constexpr const char* kSmall = R"([style]
name = "small"
metaphor = "ink"
[lattice]
detail = 64
[[stage]]
name = "only"
cost = { importance = -1.0 }
)";

std::string problem_of(const std::string& toml, const std::vector<Setting>& settings = {}) {
    try {
        parse_style(toml, "s.toml", settings);
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::bad_usage);
        return e.what();
    }
    return "";
}

TEST(StyleFile, EveryBuiltinLoadsAndSurvivesItsOwnToml) {
    ASSERT_FALSE(builtin_styles().empty());
    for (const BuiltinStyle& builtin : builtin_styles()) {
        Style style = load_style(std::string(builtin.name));
        EXPECT_EQ(style.name, builtin.name);
        EXPECT_FALSE(style.summary.empty());
        const std::string toml = style_toml(style);
        Style again = parse_style(toml, "again.toml");
        EXPECT_EQ(style_toml(again), toml) << builtin.name;
    }
}

TEST(StyleFile, MissingKeysTakeDefaultsAndGivenOnesCount) {
    const Style style = parse_style(kSmall, "s.toml");
    EXPECT_EQ(style.lattice.detail, 64);
    EXPECT_EQ(style.lattice.neighbourhood, Neighbourhood::square8);
    ASSERT_EQ(style.stages.size(), 1u);
    EXPECT_EQ(style.stages[0].cost, (FieldWeights{{"importance", -1.0f}}));
}

struct Bad {
    const char *what, *toml, *expected;
};
class BadStyle : public ::testing::TestWithParam<Bad> {};
TEST_P(BadStyle, IsRefusedWithLineColumnAndRemedy) {
    const std::string problem = problem_of(GetParam().toml);
    EXPECT_NE(problem.find(GetParam().expected), std::string::npos) << problem;
}
INSTANTIATE_TEST_SUITE_P(
    Table, BadStyle,
    ::testing::Values(
        Bad{"syntax", "[style\n", "s.toml:1:"},
        Bad{"header without a key", "[style]\n[[# name\n", "s.toml:2:3: Error while parsing key"},
        Bad{"sign for a blank", "[style]\nname \u00a7 = 1\n", "s.toml:2:6: Error while parsing"},
        Bad{"unknown key", "[style]\nmetaphor=\"ink\"\n[lattice]\ndetial = 3\n[[stage]]\n",
            "s.toml:4:1: unknown key 'lattice.detial': did you mean 'lattice.detail'?"},
        Bad{"unknown section", "[style]\nmetaphor=\"ink\"\n[latice]\ndetail = 3\n[[stage]]\n",
            "did you mean 'lattice'?"},
        Bad{"range", "[style]\nmetaphor=\"ink\"\n[lattice]\ndetail = 3\n[[stage]]\n",
            "s.toml:4:10: lattice.detail = 3 is out of range: give a whole number from 16"},
        Bad{"type", "[style]\nmetaphor=\"ink\"\n[lattice]\nmargin = \"wide\"\n[[stage]]\n",
            "lattice.margin is not a number"},
        Bad{"not a number", "[style]\nmetaphor=\"ink\"\n[lattice]\nmargin = nan\n[[stage]]\n", "out of range"},
        Bad{"choice", "[style]\nmetaphor=\"ink\"\n[[stage]]\nmetric = \"shortest\"\n",
            "use one of sum, max-sum, lexicographic, blend"},
        Bad{"colour", "[style]\nmetaphor=\"ink\"\n[ink]\nink = \"blue\"\n[[stage]]\n", "is not a colour"},
        Bad{"field", "[style]\nmetaphor=\"ink\"\n[[stage]]\ncost = { importnace = 1 }\n", "did you mean 'importance'?"},
        Bad{"turns on squares",
            "[style]\nmetaphor=\"ink\"\n[lattice]\nkind = \"regular\"\n[[stage]]\nturn_penalty = 1\n",
            "s.toml:3:1: a turn_penalty means nothing on unmoved squares"},
        Bad{"metaphor", "[style]\nmetaphor=\"oil\"\n[[stage]]\n", "use one of ink"},
        Bad{"no metaphor", "[[stage]]\n", "names no metaphor"},
        Bad{"no stage", "[style]\nmetaphor=\"ink\"\n", "has no stage"},
        Bad{"twice", "[style]\nmetaphor=\"ink\"\n[[stage]]\n[[stage]]\n", "two stages are called 'growth'"},
        Bad{"first stage", "[style]\nmetaphor=\"ink\"\n[[stage]]\nsources=\"dendrite\"\n",
            "cannot start from the dendrite"},
        Bad{"extends nothing", "[style]\nextends=\"vien\"\n", "did you mean 'vine'?"}),
    [](const auto& row) {
        std::string name = row.param.what;
        for (char& c : name)
            if (c == ' ') c = '_';
        return name;
    });

TEST(StyleFile, SettingsAddressSectionsAndStagesByName) {
    const Style style = parse_style(kSmall, "s.toml",
                                    {{"lattice.detail", "80"},
                                     {"stage.only.metric", "sum"},
                                     {"stage.only.endpoints.calm_spacing", "9.5"},
                                     {"stage.only.cost.tone", "0.5"},
                                     {"ink.ink", "#ff0000"}});
    EXPECT_EQ(style.lattice.detail, 80);
    EXPECT_EQ(style.stages[0].metric, Metric::sum);
    EXPECT_EQ(style.stages[0].endpoints.calm_spacing, 9.5f);
    EXPECT_EQ(style.stages[0].cost.size(), 2u);
}

TEST(StyleFile, BadSettingsSayWhatWasMeant) {
    EXPECT_NE(problem_of(kSmall, {{"lattice.detial", "80"}}).find("did you mean 'lattice.detail'?"), std::string::npos);
    EXPECT_NE(problem_of(kSmall, {{"lattice.detail", "8.5"}}).find("not a whole number"), std::string::npos);
    EXPECT_NE(problem_of(kSmall, {{"stage.tone.carry", "1"}}).find("its stages are only"), std::string::npos);
    EXPECT_NE(problem_of(kSmall, {{"detail", "1"}}).find("write section.key=value"), std::string::npos);
}

TEST(StyleFile, ExtendsOverridesKeysAndStagesByName) {
    const Style vine = load_style("vine");
    const Style style = parse_style(R"([style]
name = "mine"
extends = "vine"
[width]
trunk = 1.5
[[stage]]
name = "tone"
carry = 0.25
)",
                                    "mine.toml");
    EXPECT_EQ(style.name, "mine");
    EXPECT_EQ(style.width.trunk, 1.5f);
    ASSERT_EQ(style.stages.size(), vine.stages.size());
    EXPECT_EQ(style.stages[1].carry, 0.25f);
    EXPECT_EQ(style.stages[1].endpoints.calm_spacing, vine.stages[1].endpoints.calm_spacing);
    EXPECT_EQ(style.lattice.detail, vine.lattice.detail);
}

TEST(NearestName, FindsSlipsAndNothingFar) {
    EXPECT_EQ(nearest_name("vien", {"ink", "vine"}), "vine");
    EXPECT_EQ(nearest_name("qqqqqqq", {"ink", "vine"}), "");
}

}  // namespace
}  // namespace dstylize
