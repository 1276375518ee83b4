// Styles of a user's own: a folder of them, a copy to start from, files by path.
#include <cstdlib>

#include "contract/app/app_fixture.h"

namespace dstylize::test {
namespace {

class UserStylesTest : public AppTest {
  protected:
    UserStylesTest() {
        ::setenv("XDG_CONFIG_HOME", folder_.path().c_str(), 1);
        std::filesystem::create_directories(folder_ / "dstylize/styles");
    }
    ~UserStylesTest() override { ::unsetenv("XDG_CONFIG_HOME"); }

    void write_style(const std::string& name, const std::string& text) const {
        write_file(folder_ / ("dstylize/styles/" + name + ".toml"), text);
    }
};

TEST_F(UserStylesTest, AreListedDescribedAndDrawnByName) {
    write_style("mine", "[style]\nname = \"mine\"\nsummary = \"thin ink\"\nextends = \"ink\"\n[width]\nwidest = 2.5\n");
    EXPECT_NE(run({"styles"}).out.find("mine         thin ink"), std::string::npos);
    EXPECT_NE(run({"styles", "mine"}).out.find("2.5 u"), std::string::npos);
    expect_done(run({"in.png", "out.json", "--style", "mine", "--detail", "64"}));
    expect_done(draw({"in.png", "ink.json"}));
    EXPECT_NE(file_bytes(folder_ / "out.json"), file_bytes(folder_ / "ink.json"));
}

TEST_F(UserStylesTest, ABrokenOneIsToldWhereAndDoesNotHideTheOthers) {
    write_style("broken", "[style]\nextends = \"ink\"\n[width]\nwidset = 1\n");
    const Outcome listed = run({"styles"});
    EXPECT_EQ(listed.exit_code, 0);
    EXPECT_NE(listed.out.find("vine "), std::string::npos);
    EXPECT_NE(listed.out.find("broken.toml:4:1"), std::string::npos);
    expect_error(run({"in.png", "out.png", "--style", "broken"}), 2,
                 {"broken.toml:4:1", "did you mean 'width.widest'?"});
}

TEST_F(UserStylesTest, ACopyIsAStyleToStartFrom) {
    expect_done(run({"styles", "--copy", "vine", "copy.toml"}));
    const std::string copy = file_bytes(folder_ / "copy.toml");
    EXPECT_EQ(copy, file_bytes(std::filesystem::path(DSTYLIZE_SOURCE_DIR) / "filters/vine.toml"));
    expect_done(run({"in.png", "out.json", "--style", "./copy.toml", "--detail", "64"}));
    expect_error(run({"styles", "--copy", "ink", "copy.toml"}), 4, {"copy.toml", "--force"});
    EXPECT_EQ(file_bytes(folder_ / "copy.toml"), copy);
    expect_error(run({"styles", "--copy", "ink"}), 2, {"--copy"});
    expect_error(run({"styles", "--copy", "inkk", "x.toml"}), 2, {"did you mean 'ink'?"});
}

}  // namespace
}  // namespace dstylize::test
