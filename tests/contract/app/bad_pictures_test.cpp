// Pictures that cannot be drawn give exit code 3 and one line; odd ones that can be are drawn.
#include <set>

#include "contract/app/app_fixture.h"

namespace dstylize::test {
namespace {

class BadPictureTest : public AppTest {
  protected:
    /// The picture in `file` is refused, and that leaves nothing.
    void expect_refused(const std::string& file, const Words& says) {
        const auto before = folder_.names();
        Words all{file};
        all.insert(all.end(), says.begin(), says.end());
        expect_error(draw({file, "out.png"}), 3, all);
        EXPECT_EQ(folder_.names(), before);
    }
    /// The picture in `file` is drawn at its own size, in more than one colour if there is `something`.
    void expect_drawn(const std::string& file, Extent size, bool something = true) {
        expect_done(draw({file, "out.png"}));
        const Picture drawing = read_picture(folder_ / "out.png").picture;
        EXPECT_EQ(drawing.extent(), size);
        std::set<int> tones;
        for (const Rgba8 p : drawing) tones.insert(p.r);
        EXPECT_GT(tones.size(), something ? 2u : 0u);
    }
    std::string picture_bytes(const std::string& format) {
        write_picture(folder_ / ("whole." + format), scene({300, 200}));
        return file_bytes(folder_ / ("whole." + format));
    }
};

TEST_F(BadPictureTest, MissingIsRefused) { expect_refused("no.png", {"no such file"}); }

TEST_F(BadPictureTest, EmptyIsRefused) {
    write_file(folder_ / "empty.png", "");
    expect_refused("empty.png", {"empty"});
}

TEST_F(BadPictureTest, TruncatedIsRefusedInEveryFormat) {
    for (const std::string format : {"png", "jpg", "tif", "webp"}) {
        const std::string whole = picture_bytes(format);
        write_file(folder_ / ("cut." + format), whole.substr(0, whole.size() * 6 / 10));
        expect_refused("cut." + format, {});
    }
}

TEST_F(BadPictureTest, TruncatedIsDrawnWhenAllowed) {
    const std::string whole = picture_bytes("jpg");
    write_file(folder_ / "cut.jpg", whole.substr(0, whole.size() * 6 / 10));
    const Outcome outcome = draw({"cut.jpg", "out.png", "--allow-damaged"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(read_picture(folder_ / "out.png").picture.extent(), (Extent{300, 200}));
}

TEST_F(BadPictureTest, TextIsRefused) {
    write_file(folder_ / "text.png", "this is no picture\n");
    expect_refused("text.png", {});
}

TEST_F(BadPictureTest, ZeroSizeIsRefused) {
    write_file(folder_ / "zero.ppm", "P6\n0 0\n255\n");
    expect_refused("zero.ppm", {});
}

TEST_F(BadPictureTest, AWrongExtensionDoesNotMatter) {
    write_file(folder_ / "really_png.jpg", picture_bytes("png"));
    expect_drawn("really_png.jpg", {300, 200});
}

TEST_F(BadPictureTest, OnePixelIsDrawn) {
    write_png(folder_ / "dot.png", flat({1, 1}, {10, 20, 30, 255}));
    expect_drawn("dot.png", {1, 1}, false);
}

TEST_F(BadPictureTest, AColumnAndARowAreDrawn) {
    write_png(folder_ / "column.png", scene({1, 4000}));
    expect_drawn("column.png", {1, 4000}, false);
    write_png(folder_ / "row.png", scene({4000, 1}));
    expect_drawn("row.png", {4000, 1}, false);
}

TEST_F(BadPictureTest, LongerThanADrawingIsRefusedUnlessASizeIsAsked) {
    write_png(folder_ / "line.png", scene({70000, 1}));
    expect_refused("line.png", {"70000 pixels long", "--size"});
    expect_done(draw({"line.png", "out.png", "--size", "600"}));
}

TEST_F(BadPictureTest, OneColourIsDrawn) {
    for (const std::uint8_t grey : {0, 128, 255}) {
        write_png(folder_ / "flat.png", flat({80, 60}, {grey, grey, grey, 255}));
        expect_drawn("flat.png", {80, 60}, false);
    }
}

TEST_F(BadPictureTest, AllTransparentIsRefusedByName) {
    write_png(folder_ / "glass.png", flat({80, 60}, {0, 0, 0, 0}));
    const auto before = folder_.names();
    expect_error(draw({"glass.png", "out.png"}), 1, {"glass.png", "nothing can grow"});
    EXPECT_EQ(folder_.names(), before);
}

TEST_F(BadPictureTest, EvenlyTranslucentIsDrawn) {
    Picture picture = scene({96, 64});
    for (Rgba8& p : picture) p.a = 90;
    write_png(folder_ / "veil.png", picture);
    expect_drawn("veil.png", {96, 64});
}

TEST_F(BadPictureTest, TransparentPartsStayEmpty) {
    Picture picture = scene({96, 64});
    for (int y = 0; y < 64; ++y)
        for (int x = 48; x < 96; ++x) picture(x, y) = {0, 0, 0, 0};
    write_png(folder_ / "half.png", picture);
    expect_done(draw({"half.png", "out.png"}));
    const Picture drawing = read_picture(folder_ / "out.png").picture;
    for (int y = 0; y < 64; ++y)
        for (int x = 56; x < 96; ++x) ASSERT_EQ(drawing(x, y).r, 255) << x << "," << y;
}

TEST_F(BadPictureTest, SixteenBitIsDrawn) {
    write_file(folder_ / "deep.ppm", pnm16(120, 80));
    expect_drawn("deep.ppm", {120, 80});
}

TEST_F(BadPictureTest, CmykIsDrawnInItsColours) {
    write_file(folder_ / "ink.tif", cmyk_tiff(40, 30));
    expect_done(draw({"ink.tif", "out.png", "--background", "input"}));
    EXPECT_EQ(read_picture(folder_ / "out.png").picture.extent(), (Extent{40, 30}));
}

TEST_F(BadPictureTest, NotANumberIsDrawn) {
    write_file(folder_ / "nan.exr", exr_with_nan(60, 40));
    expect_drawn("nan.exr", {60, 40}, false);
}

TEST_F(BadPictureTest, AMaskOfAnotherSizeIsStretched) {
    Picture left = flat({10, 7}, {0, 0, 0, 255});
    for (int y = 0; y < 7; ++y)
        for (int x = 0; x < 5; ++x) left(x, y) = {255, 255, 255, 255};
    write_png(folder_ / "left.png", left);
    expect_done(draw({"in.png", "out.png", "--mask", "left.png"}));
    const Picture drawing = read_picture(folder_ / "out.png").picture;
    int drawn = 0;
    for (int y = 0; y < kSize.y; ++y) {
        for (int x = 0; x < kSize.x / 2; ++x) drawn += drawing(x, y).r < 128;
        for (int x = kSize.x / 2 + 8; x < kSize.x; ++x) ASSERT_EQ(drawing(x, y).r, 255) << x << "," << y;
    }
    EXPECT_GT(drawn, 50);
}

}  // namespace
}  // namespace dstylize::test
