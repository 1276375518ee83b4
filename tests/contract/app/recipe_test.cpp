// A drawing is made again from what it carries.
#include "contract/app/app_fixture.h"

namespace dstylize::test {
namespace {

class RecipeTest : public AppTest {
  protected:
    RecipeTest() {
        write_png(folder_ / "mask.png", flat({9, 9}, {255, 255, 255, 255}));
        write_png(folder_ / "map.png", scene({40, 40}));
        write_png(folder_ / "ground.png", flat({50, 50}, {220, 200, 180, 255}));
    }
    Words everything(Words words) const {
        words.insert(words.end(), {"--seed", "77", "--root", "0.5,0.9", "--root", "3,60", "--size", "200%", "--mask",
                                   "mask.png", "--importance", "map.png", "--importance-mode", "replace",
                                   "--background", "ground.png", "--set", "width.widest=5.3"});
        return words;
    }
    Picture picture(const std::string& name) const { return read_picture(folder_ / name).picture; }
};

TEST_F(RecipeTest, ReplayFromEveryFormatGivesTheSamePixels) {
    expect_done(draw(everything({"in.png", "a.png", "-o", "a.jpg", "-o", "a.tif", "-o", "a.webp", "-o", "a.svg", "-o",
                                 "a.pdf", "-o", "a.json", "--recipe", "a.toml"})));
    for (const std::string format : {"png", "jpg", "tif", "webp", "svg", "pdf", "json", "toml"}) {
        expect_done(run({"replay", "a." + format, "in.png", "again.png"}));
        EXPECT_TRUE(picture("again.png") == picture("a.png")) << format;
        EXPECT_TRUE(file_bytes(folder_ / "again.png") == file_bytes(folder_ / "a.png")) << format;
    }
}

TEST_F(RecipeTest, EveryStyleIsWhatItsRecipeSays) {
    for (const std::string style : {"ink", "vine"}) {
        expect_done(run({"in.png", "a.png", "--style", style, "--detail", "64"}));
        expect_done(run({"replay", "a.png", "in.png", "again.png"}));
        EXPECT_TRUE(file_bytes(folder_ / "again.png") == file_bytes(folder_ / "a.png")) << style;
    }
}

TEST_F(RecipeTest, EndpointsAreReplayedToo) {
    write_file(folder_ / "ends.csv", "x,y\n0.1,0.1\n0.9, 0.1\n48,5,dendrite\n");
    expect_done(draw({"in.png", "a.svg", "--endpoints", "ends.csv"}));
    expect_done(run({"replay", "a.svg", "in.png", "b.svg"}));
    EXPECT_TRUE(file_bytes(folder_ / "b.svg") == file_bytes(folder_ / "a.svg"));
}

TEST_F(RecipeTest, ReplayTakesAnotherSize) {
    expect_done(draw({"in.png", "a.svg"}));
    expect_done(run({"replay", "a.svg", "in.png", "large.png", "--size", "300"}));
    expect_done(draw({"in.png", "wanted.png", "--size", "300"}));
    EXPECT_TRUE(picture("large.png") == picture("wanted.png"));
}

TEST_F(RecipeTest, TheRecipeFileIsAStyle) {
    expect_done(draw({"in.png", "a.json", "--set", "stroke.smooth=9", "--recipe", "a.toml"}));
    expect_done(run({"in.png", "b.json", "--style", "a.toml", "--no-recipe"}));
    const auto skeleton = [&](const std::string& name) {
        const std::string text = file_bytes(folder_ / name);
        return text.substr(text.find("\"stages\""));
    };
    EXPECT_GT(skeleton("a.json").size(), 1000u);
    EXPECT_EQ(skeleton("b.json"), skeleton("a.json"));
}

TEST_F(RecipeTest, AnotherInputIsDrawnAndSaid) {
    expect_done(draw({"in.png", "a.png"}));
    write_png(folder_ / "other.png", scene({60, 60}));
    const Outcome outcome = run({"replay", "a.png", "other.png", "b.png"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_NE(outcome.err.find("other.png: is not the picture that a.png was made from"), std::string::npos)
        << outcome.err;
    EXPECT_EQ(picture("b.png").extent(), (Extent{60, 60}));
    expect_done(run({"replay", "a.png", "other.png", "b.png", "--quiet"}));
}

TEST_F(RecipeTest, NoRecipeLeavesItOut) {
    for (const std::string format : {"png", "jpg", "tif", "webp", "svg", "pdf", "json"}) {
        expect_done(draw({"in.png", "a." + format, "--no-recipe"}));
        expect_error(run({"replay", "a." + format, "in.png", "b.png"}), 3, {"a." + format, "carries no recipe"});
    }
}

TEST_F(RecipeTest, AuxiliaryFilesAreFoundBesideTheDrawing) {
    expect_done(draw(everything({"in.png", "a.png"})));
    const auto elsewhere = folder_ / "elsewhere";
    std::filesystem::create_directory(elsewhere);
    for (const char* name : {"a.png", "mask.png", "map.png", "ground.png"})
        std::filesystem::rename(folder_ / name, elsewhere / name);
    expect_done(run({"replay", "elsewhere/a.png", "in.png", "b.png"}));
    EXPECT_TRUE(picture("b.png") == picture("elsewhere/a.png"));
}

TEST_F(RecipeTest, AMissingOrChangedAuxiliaryFileIsRefused) {
    expect_done(draw(everything({"in.png", "a.png"})));
    write_png(folder_ / "map.png", flat({40, 40}, {200, 200, 200, 255}));
    expect_error(run({"replay", "a.png", "in.png", "b.png"}), 3, {"map.png", "is not the file"});
    std::filesystem::remove(folder_ / "map.png");
    expect_error(run({"replay", "a.png", "in.png", "b.png"}), 3, {"map.png", "missing"});
    EXPECT_FALSE(std::filesystem::exists(folder_ / "b.png"));
}

TEST_F(RecipeTest, ADamagedRecipeIsRefused) {
    expect_done(draw({"in.png", "a.png", "--recipe", "a.toml"}));
    const std::string whole = file_bytes(folder_ / "a.toml");
    write_file(folder_ / "cut.toml", whole.substr(0, whole.find("seed")) + "seed = \n");
    expect_error(run({"replay", "cut.toml", "in.png", "b.png"}), 3, {"cut.toml:"});
    write_file(folder_ / "odd.toml", "[recipe]\nseed = 'one'\n");
    expect_error(run({"replay", "odd.toml", "in.png", "b.png"}), 3, {"odd.toml", "recipe.seed"});
    write_file(folder_ / "none.toml", "[style]\nmetaphor = 'ink'\n");
    expect_error(run({"replay", "none.toml", "in.png", "b.png"}), 3, {"none.toml", "no recipe"});
}

}  // namespace
}  // namespace dstylize::test
