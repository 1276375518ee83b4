#include "formats/skeleton.h"

#include <gtest/gtest.h>

#include <functional>
#include <locale>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/noise.h"

namespace dstylize {
namespace {

using nlohmann::json;

const DocumentInfo kVineInfo{0, 0, "Vine", {{"author", "Zoë"}, {"recipe", "[style]\n\"x\" = 1\n"}}};

/// Three roots with random branches.
Skeleton sample() {
    Skeleton s{{}, {40, 30}, {800, 600}, {"skeleton", "fill \"two\""}, {}};
    const Noise noise(4, Purpose::jitter);
    for (std::uint32_t v = 0; v < 200; ++v) {
        const bool root = v < 3;
        const std::uint32_t parent = root ? Dendrite::kRoot : noise.bits(v) % v;
        const auto owner = root ? std::uint16_t(v) : s.dendrite.owner[parent];
        const std::uint8_t stage = v < 100 ? 0 : 1;
        const NodeId node = v % 17 == 5 ? kNoNode : NodeId{noise.bits(1000 + v) % 1200};
        s.dendrite.add(node, {40 * noise.unit(2000 + v) - 0.5f, 30 * noise.unit(3000 + v)}, parent, owner, stage);
        s.width_u.push_back(5 * noise.unit(4000 + v));
    }
    return s;
}

void expect_rejected(const std::string& text, const std::string& why = "") {
    try {
        read_skeleton_json(text);
        ADD_FAILURE() << "taken: " << text.substr(0, 200);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::cannot_read);
        EXPECT_NE(error.problem().find(why), std::string::npos) << error.problem();
    }
}

TEST(SkeletonJson, ReadsBackWhatItWrote) {
    const Skeleton a = sample();
    const Skeleton b = read_skeleton_json(skeleton_json(a, kVineInfo));
    EXPECT_EQ(b.lattice, a.lattice);
    EXPECT_EQ(b.picture, a.picture);
    EXPECT_EQ(b.stage_names, a.stage_names);
    EXPECT_EQ(b.dendrite.node, a.dendrite.node);
    EXPECT_EQ(b.dendrite.parent, a.dendrite.parent);
    EXPECT_EQ(b.dendrite.owner, a.dendrite.owner);
    EXPECT_EQ(b.dendrite.stage, a.dendrite.stage);
    ASSERT_EQ(b.dendrite.position_lattice.size(), a.dendrite.size());
    ASSERT_EQ(b.width_u.size(), a.width_u.size());
    for (std::size_t v = 0; v < a.dendrite.size(); ++v) {
        EXPECT_NEAR(b.dendrite.position_lattice[v].x, a.dendrite.position_lattice[v].x, 0.00501);
        EXPECT_NEAR(b.dendrite.position_lattice[v].y, a.dendrite.position_lattice[v].y, 0.00501);
        EXPECT_NEAR(b.width_u[v], a.width_u[v], 0.000501);
    }
    // Rounding happens once.
    EXPECT_EQ(skeleton_json(b, kVineInfo), skeleton_json(a, kVineInfo));
}

TEST(SkeletonJson, IsJsonThatSaysWhatItHolds) {
    Skeleton s = sample();
    const json j = json::parse(skeleton_json(s, kVineInfo));
    EXPECT_EQ(j["format"], "dstylize skeleton");
    EXPECT_EQ(j["info"]["author"], "Zoë");
    EXPECT_EQ(j["info"]["recipe"], "[style]\n\"x\" = 1\n");
    EXPECT_EQ(j["title"], "Vine");
    EXPECT_EQ(j["count"], 200);
    EXPECT_EQ(j["parent"][0], -1);
    EXPECT_EQ(j["node"][5], -1);
    s.width_u.clear();
    EXPECT_FALSE(json::parse(skeleton_json(s, kVineInfo)).contains("width"));
    EXPECT_TRUE(read_skeleton_json(skeleton_json(s, kVineInfo)).width_u.empty());
}

TEST(SkeletonJson, NumbersAreExactHundredths) {
    Skeleton s{{}, {10, 10}, {10, 10}, {}, {}};
    for (const float x : {0.0f, -0.5f, 1.0f, 2.05f, 3.104f, 9.999f, -0.001f})
        s.dendrite.add(NodeId{0}, {x, 0.5f}, Dendrite::kRoot, 0, 0);
    EXPECT_NE(skeleton_json(s, {}).find("\"x\": [0,-0.5,1,2.05,3.1,10,0]"), std::string::npos) << skeleton_json(s, {});
}

TEST(SkeletonJson, EmptyOneIsFine) {
    const Skeleton s{{}, {1, 1}, {1, 1}, {}, {}};
    EXPECT_EQ(read_skeleton_json(skeleton_json(s, {})).dendrite.size(), 0u);
}

TEST(SkeletonJson, DoesNotDependOnTheLocale) {
    struct Comma : std::numpunct<char> {
        char do_decimal_point() const override { return ','; }
        char do_thousands_sep() const override { return '.'; }
        std::string do_grouping() const override { return "\3"; }
    };
    Skeleton s = sample();
    s.picture.x = 123456;
    const std::string here = skeleton_json(s, kVineInfo);
    const std::locale before = std::locale::global(std::locale(std::locale(), new Comma));
    const std::string there = skeleton_json(s, kVineInfo);
    std::locale::global(before);
    EXPECT_EQ(here, there);
}

TEST(SkeletonJson, BadUtf8InTextsIsReplaced) {
    EXPECT_EQ(json::parse(skeleton_json(sample(), {0, 0, "a\xff z", {}}))["title"], "a\xEF\xBF\xBD z");
}

TEST(SkeletonJson, TextThatIsNotSuchAnObjectIsRejected) {
    for (const char* text : {"", "{", "[]", "null", "3", "{}", "{\"format\":\"other\"}", "{\"format\":7}", "\xff\xfe"})
        expect_rejected(text);
    expect_rejected(std::string(100000, '['));
    std::string text = skeleton_json(sample(), kVineInfo);
    expect_rejected(text.substr(0, text.size() / 2), "not JSON");
    expect_rejected(text + "x", "not JSON");
}

TEST(SkeletonJson, EveryBrokenPartIsRejected) {
    struct Case {
        const char* name;
        std::function<void(json&)> damage;
    };
    const std::vector<Case> cases = {
        {"newer version", [](json& j) { j["version"] = 2; }},
        {"version is a text", [](json& j) { j["version"] = "1"; }},
        {"empty lattice",
         [](json& j) {
             j["lattice"] = {0, 30};
         }},
        {"negative lattice",
         [](json& j) {
             j["lattice"] = {-40, 30};
         }},
        {"three sides",
         [](json& j) {
             j["lattice"] = {40, 30, 1};
         }},
        {"fractional side",
         [](json& j) {
             j["lattice"] = {40.5, 30};
         }},
        {"huge lattice",
         [](json& j) {
             j["lattice"] = {1 << 20, 1 << 20};
         }},
        {"wrapping side",
         [](json& j) {
             j["lattice"] = {18446744073709551615ull, 30};
         }},
        {"picture without size",
         [](json& j) {
             j["picture"] = {800, 0};
         }},
        {"stage names missing", [](json& j) { j.erase("stages"); }},
        {"stage name is a number",
         [](json& j) {
             j["stages"] = {"a", 2};
         }},
        {"too many stages", [](json& j) { j["stages"] = std::vector<std::string>(257, "s"); }},
        {"a stage without a name", [](json& j) { j["stages"] = {"a"}; }},
        {"count missing", [](json& j) { j.erase("count"); }},
        {"count too small", [](json& j) { j["count"] = 199; }},
        {"count too large", [](json& j) { j["count"] = 1 << 27; }},
        {"count negative", [](json& j) { j["count"] = -1; }},
        {"x missing", [](json& j) { j.erase("x"); }},
        {"x is an object", [](json& j) { j["x"] = json::object(); }},
        {"y short", [](json& j) { j["y"].erase(j["y"].begin()); }},
        {"width short", [](json& j) { j["width"].erase(j["width"].begin()); }},
        {"width is null", [](json& j) { j["width"] = nullptr; }},
        {"negative width", [](json& j) { j["width"][7] = -0.1; }},
        {"immense width", [](json& j) { j["width"][7] = 1e30; }},
        {"x is null", [](json& j) { j["x"][7] = nullptr; }},
        {"x far out", [](json& j) { j["x"][7] = 81; }},
        {"y far out", [](json& j) { j["y"][7] = -31; }},
        {"y overflows", [](json& j) { j["y"][7] = 1e300; }},
        {"node out of the lattice", [](json& j) { j["node"][7] = 1200; }},
        {"node below -1", [](json& j) { j["node"][7] = -2; }},
        {"parent is itself", [](json& j) { j["parent"][7] = 7; }},
        {"parent comes later", [](json& j) { j["parent"][7] = 9; }},
        {"parent below -1", [](json& j) { j["parent"][7] = -2; }},
        {"fractional parent", [](json& j) { j["parent"][7] = 1.5; }},
        {"another owner than the parent", [](json& j) { j["owner"][7] = 9; }},
        {"owner too large", [](json& j) { j["owner"][7] = 65535; }},
        {"stage too large", [](json& j) { j["stage"][7] = 256; }},
        {"stage before the parent's", [](json& j) { j["stage"][0] = 1; }},
        {"stage is true", [](json& j) { j["stage"][7] = true; }},
    };
    for (const Case& c : cases) {
        SCOPED_TRACE(c.name);
        json j = json::parse(skeleton_json(sample(), kVineInfo));
        EXPECT_NO_THROW(read_skeleton_json(j.dump()));
        c.damage(j);
        expect_rejected(j.dump());
    }
}

TEST(SkeletonJson, AnyChangedByteIsReadOrRejectedCleanly) {
    const std::string good = skeleton_json(sample(), kVineInfo);
    const Noise noise(9, Purpose::jitter);
    for (std::uint64_t k = 0; k < 3000; ++k) {
        std::string text = good;
        text[noise.bits(2 * k) % text.size()] = char(noise.bits(2 * k + 1));
        try {
            EXPECT_EQ(first_fault(read_skeleton_json(text).dendrite), "");
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::cannot_read);
        }
    }
}

TEST(SkeletonJson, UnknownKeysAreIgnored) {
    json j = json::parse(skeleton_json(sample(), kVineInfo));
    j["future"] = {1, 2, 3};
    EXPECT_EQ(read_skeleton_json(j.dump()).dendrite.size(), 200u);
}

}  // namespace
}  // namespace dstylize
