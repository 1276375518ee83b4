// A parameter that changes nothing is a lie to its reader: each has an effect on the drawing of some built-in style.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/error.h"
#include "pipeline/style_file.h"
#include "pipeline/stylize.h"
#include "render/raster.h"
#include "support/quick_style.h"
#include "support/scenes.h"

namespace dstylize {
namespace {

/// Names every change that can be tried by the parameter's key; all stages share theirs ("stage.carry").
class KeyedVisitor : public ParameterVisitor {
  public:
    void number(ParameterDoc doc, float& value, float lo, float hi) override {
        // Some way up and down: ends of a range may switch a whole part off.
        at(doc.key, [&] { value = value > lo ? lo + 0.4f * (value - lo) : lo + 0.3f * (hi - lo); });
        at(doc.key, [&] { value = lo + 0.8f * (hi - lo); });
        at(doc.key, [&] { value = lo + 0.02f * (hi - lo); });
    }
    void integer(ParameterDoc doc, int& value, int lo, int hi) override {
        at(doc.key, [&] { value = std::min(hi, std::max(value + 1, 2 * value)); });
        at(doc.key, [&] { value = std::max(lo, value / 2); });
    }
    void flag(ParameterDoc doc, bool& value) override {
        at(doc.key, [&] { value = !value; });
    }
    void choice(ParameterDoc doc, int& value, std::span<const std::string_view> names) override {
        for (std::size_t n = 1; n < names.size(); ++n)
            at(doc.key, [&] { value = int((std::size_t(value) + n) % names.size()); });
    }
    void colour(ParameterDoc doc, Rgba& value) override {
        at(doc.key, [&] { value = {1 - value.r, 1 - value.g, 1 - value.b, value.a}; });
    }
    void text(ParameterDoc doc, std::string& value) override {
        for (const char* field : {"tone", "lines"}) at(doc.key, [&] { value = field; });
    }
    void field_weights(ParameterDoc doc, FieldWeights& value) override {
        at(doc.key, [&] { value = {{"tone", 0.5f}}; });
    }
    void section(std::string_view key, std::string_view, const std::function<void(ParameterVisitor&)>& visit) override {
        const std::string outer = prefix_;
        prefix_ += std::string(key.starts_with("stage.") ? "stage" : key) + ".";
        visit(*this);
        prefix_ = outer;
    }

  protected:
    virtual void at(std::string_view key, const std::function<void()>& change) = 0;
    std::string prefix_;
};

/// The keys of all changes that can be tried.
class Changes : public KeyedVisitor {
  public:
    std::vector<std::string> keys;

  private:
    void at(std::string_view key, const std::function<void()>&) override { keys.push_back(prefix_ + std::string(key)); }
};

/// Makes the change of that number.
class Change : public KeyedVisitor {
  public:
    explicit Change(std::size_t number) : left_(number) {}

  private:
    void at(std::string_view, const std::function<void()>& change) override {
        if (left_-- == 0) change();
    }
    std::size_t left_;
};

constexpr Extent kFrame{160, 120};

/// One of every kind, quick ones first; the others build on these.
constexpr std::array kStyles{"vine",  "letters",        "tree", "autumn",    "lightning",
                             "storm", "lichen-letters", "ink",  "pareidolia"};

/// The styles that a table's keys are tried on: all, but stages are many, so for theirs the one that uses them.
std::vector<std::string> styles_for(const std::string& key) {
    if (!key.starts_with("stage.")) return {kStyles.begin(), kStyles.end()};
    static const std::map<std::string, std::string> kOthers{{"stage.down", "lightning"},
                                                            {"stage.endpoints.keep_off", "lightning"},
                                                            {"stage.endpoints.close_loops", "letters"},
                                                            {"stage.cost_power", "letters"},
                                                            {"stage.endpoints.density_toe", "vine"},
                                                            {"stage.endpoints.most", "tree"},
                                                            {"stage.endpoints.reach", "tree"},
                                                            {"stage.endpoints.first_spacing", "tree"},
                                                            {"stage.bare", "tree"},
                                                            {"stage.batches", "tree"},
                                                            {"stage.turn_penalty", "tree"},
                                                            {"stage.blend_factor", "tree"},
                                                            {"stage.carry_cost", "tree"},
                                                            {"stage.layer", "tree"},
                                                            {"stage.noise_scale", "tree"},
                                                            {"stage.path_inside", "tree"},
                                                            {"stage.path_lack", "tree"},
                                                            {"stage.path_longest", "tree"},
                                                            {"stage.up", "tree"},
                                                            {"stage.wind", "tree"}};
    const auto other = kOthers.find(key);
    return {other == kOthers.end() ? "vine" : other->second};
}

/// Quick to draw, and so that its own parameters count.
Style small_style(const std::string& name, const std::string& table) {
    std::vector<Setting> settings{{"lattice.detail", table == "vine." ? "400" : "96"}};
    static const std::map<std::string, std::vector<Setting>> kMore{
        {"lichen-letters", {{"lichen.species", "own"}, {"lichen.cups", "100"}}},
        {"storm", {{"storm.shine_tone", "0.5"}}},
        {"vine",
         {{"width.constant", "0.2"},
          {"fields.calm_scale", "5"},
          {"fields.calm_detail", "1"},
          {"fields.calm_tone", "1"}}}};
    if (const auto more = kMore.find(name); more != kMore.end())
        settings.insert(settings.end(), more->second.begin(), more->second.end());
    // Growths that are to be chosen among must differ.
    return table == "choice." ? load_style(name, settings) : test::quick_style(name, settings);
}

struct Result {
    std::vector<NodeId> node;
    std::vector<float> width;
    Picture picture;
    bool operator==(const Result&) const = default;
};

std::optional<Result> result(const Style& style) {
    Controls controls;
    Picture picture = test::scene(kFrame);
    for (Rgba8& p : picture) p.b = std::uint8_t(p.b / 2);  // hues have a say, too
    if (style.name.find("letters") != std::string::npos) {
        picture = test::flat(kFrame, {255, 255, 255, 255});  // plain paper
        controls.mask = test::flat(kFrame, {0, 0, 0, 255});
        for (int y = 20; y < 100; ++y)
            for (int x = 30; x < 130; ++x)
                if (x < 62 || (x > 98 && y > 40) || (y > 50 && y < 76)) (*controls.mask)(x, y) = {255, 255, 255, 255};
    }
    try {
        Drawing d = stylize(picture, style, controls);
        return Result{d.dendrite.node, d.width_u, raster(d.list, {kFrame}, {})};
    } catch (const Error&) {
        return {};  // refused: not an effect
    }
}

/// Tested one by one below.
constexpr std::array kNeedMoreThanAPicture{"fields.calm_detail", "fields.calm_scale",  "fields.calm_tone",
                                           "root.every_part",    "root.smallest_part", "stage.name",
                                           "vine.leaf_at_least"};

class EveryParameter : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryParameter, ChangesTheDrawingOfSomeStyle) {
    const std::string table = GetParam() + ".";
    std::set<std::string> all, effective;
    for (const char* name : kStyles) {
        const auto fresh = [&] { return small_style(name, table); };
        Style first = fresh();
        Changes changes;
        first.visit(changes);
        std::optional<Result> before;
        for (std::size_t n = 0; n < changes.keys.size(); ++n) {
            const std::string& key = changes.keys[n];
            if (!key.starts_with(table)) continue;
            all.insert(key);
            if (effective.contains(key) || !std::ranges::count(styles_for(key), name)) continue;
            if (!before) before = result(first);
            Style changed = fresh();
            Change change(n);
            changed.visit(change);
            const std::optional<Result> after = result(changed);
            if (after && *after != *before) effective.insert(key);
        }
        if (!all.empty() && std::ranges::includes(effective, all)) break;
    }
    EXPECT_FALSE(all.empty());
    for (const char* key : kNeedMoreThanAPicture) all.erase(key);
    std::vector<std::string> idle;
    std::set_difference(all.begin(), all.end(), effective.begin(), effective.end(), std::back_inserter(idle));
    EXPECT_TRUE(idle.empty()) << ::testing::PrintToString(idle);
}

/// All tables but those that only say who a style is or need more than a picture.
std::vector<std::string> tables() {
    std::set<std::string> out;
    for (const BuiltinStyle& builtin : builtin_styles()) {
        Style style = load_style(std::string(builtin.name));
        Changes changes;
        style.visit(changes);
        for (const std::string& key : changes.keys) out.insert(key.substr(0, key.find('.')));
    }
    out.erase("style");
    out.erase("scene");  // tests/contract/app/scene_test.cpp
    return {out.begin(), out.end()};
}
INSTANTIATE_TEST_SUITE_P(Table, EveryParameter, ::testing::ValuesIn(tables()),
                         [](const auto& row) { return row.param; });

std::size_t leaves(const std::vector<Setting>& settings) {
    std::vector<Setting> all{{"lattice.detail", "400"}};
    all.insert(all.end(), settings.begin(), settings.end());
    const Drawing d = stylize(test::scene({400, 300}), load_style("vine", all), {});
    std::size_t fills = 0;
    for (const Layer& layer : d.list.layers)
        fills += std::size_t(
            std::ranges::count_if(layer.items, [](const Item& item) { return std::holds_alternative<Fill>(item); }));
    return fills;
}

TEST(ParameterEffects, LeavesGrowWhereThePictureIsCalm) {
    const std::size_t usual = leaves({});
    EXPECT_GT(usual, 0u);
    EXPECT_LT(leaves({{"fields.calm_detail", "0"}}), usual);
    EXPECT_LT(leaves({{"fields.calm_tone", "0"}}), usual);
    EXPECT_NE(leaves({{"fields.calm_scale", "200"}}), usual);
    EXPECT_EQ(leaves({{"vine.leaf_at_least", "10000"}}), 0u);
}

/// A wide part and an islet of 6 x 6 pixels.
std::size_t roots(const std::vector<Setting>& settings, bool own_root) {
    Controls controls;
    controls.mask = test::flat(kFrame, {0, 0, 0, 255});
    for (int y = 20; y < 100; ++y)
        for (int x = 20; x < 140; ++x)
            if (x < 90 || (x >= 120 && x < 126 && y >= 50 && y < 56)) (*controls.mask)(x, y) = {255, 255, 255, 255};
    if (own_root) controls.roots = {{{}, {0.3, true}, {0.5, true}}};
    std::vector<Setting> all{{"lattice.detail", "160"}, {"lattice.stem", "0"}};
    all.insert(all.end(), settings.begin(), settings.end());
    const Drawing d = stylize(test::scene(kFrame), load_style("ink", all), controls);
    std::size_t count = 0;
    for (std::uint32_t v = 0; v < d.dendrite.size(); ++v) count += d.dendrite.is_root(v);
    return count;
}

TEST(ParameterEffects, SmallPartsGetNoRoot) {
    EXPECT_EQ(roots({{"root.smallest_part", "0"}}, false), 2u);
    EXPECT_EQ(roots({{"root.smallest_part", "100000"}}, false), 1u);
}

TEST(ParameterEffects, PartsWithoutAUsersRootMayGetOne) {
    EXPECT_EQ(roots({{"root.every_part", "false"}, {"root.smallest_part", "0"}}, true), 1u);
    EXPECT_EQ(roots({{"root.every_part", "true"}, {"root.smallest_part", "0"}}, true), 2u);
}

}  // namespace
}  // namespace dstylize
