// A drawing in a place of a background picture.
#include "contract/app/app_fixture.h"

namespace dstylize::test {
namespace {

class SceneTest : public AppTest {
  protected:
    SceneTest() { write_png(folder_ / "land.png", flat({160, 120}, {120, 150, 90, 255})); }
    Picture placed(const std::string& name, const Words& more) const {
        Words words{"in.png", name, "--background", "land.png", "--place", "40,20,80,80"};
        words.insert(words.end(), more.begin(), more.end());
        expect_done(draw(words));
        return read_picture(folder_ / name).picture;
    }
};

TEST_F(SceneTest, OutsideThePlaceTheBackgroundIsUntouched) {
    const Picture out = placed("a.png", {"--set", "scene.painted=0"});
    ASSERT_EQ(out.extent(), (Extent{160, 120}));
    std::size_t drawn = 0;
    for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 160; ++x) {
            const bool inside = x >= 38 && x < 122 && y >= 18 && y < 102;
            if (out(x, y) == Rgba8{120, 150, 90, 255}) continue;
            ASSERT_TRUE(inside) << x << "," << y;
            ++drawn;
        }
    EXPECT_GT(drawn, 100u);
}

TEST_F(SceneTest, MultiplyNeverLightensAndScreenNeverDarkens) {
    const Picture dark = placed("a.png", {"--set", "scene.painted=0", "--blend", "multiply"});
    const Picture light = placed("b.png", {"--set", "scene.painted=0", "--blend", "screen"});
    for (const Rgba8 p : dark) ASSERT_TRUE(p.r <= 120 && p.g <= 150 && p.b <= 90);
    for (const Rgba8 p : light) ASSERT_TRUE(p.r >= 120 && p.g >= 150 && p.b >= 90);
    EXPECT_FALSE(dark == light);
}

TEST_F(SceneTest, AReplayGivesTheSameBytes) {
    placed("a.png", {"--blend", "multiply"});
    expect_done(run({"replay", "a.png", "in.png", "b.png"}));
    EXPECT_TRUE(file_bytes(folder_ / "a.png") == file_bytes(folder_ / "b.png"));
}

TEST_F(SceneTest, PaintingALargeBackgroundCountsAsMemory) {
    write_picture(folder_ / "wide.png", flat({2048, 2048}, {120, 150, 90, 255}));
    const Words words{"in.png", "a.png", "--background", "wide.png",     "--place", "0.1,0.1,0.5,0.5",
                      "--size", "100",   "--dry-run",    "--max-memory", "512M"};
    expect_error(draw(words), 2, {"in.png", "GiB", "smaller background", "scene.painted=0"});
    Words unpainted = words;
    unpainted.insert(unpainted.end(), {"--set", "scene.painted=0"});
    EXPECT_EQ(draw(unpainted).exit_code, 0);
}

TEST_F(SceneTest, ASkeletonIsOfTheDrawingAloneWithOrWithoutAPlace) {
    placed("a.png", {"-o", "placed.json", "--no-recipe"});
    expect_done(draw({"in.png", "alone.json", "--no-recipe"}));
    EXPECT_TRUE(file_bytes(folder_ / "placed.json") == file_bytes(folder_ / "alone.json"));
}

}  // namespace
}  // namespace dstylize::test
