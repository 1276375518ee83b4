// Same command, same bytes; the drawing depends neither on threads nor on the output's size.
#include "contract/app/app_fixture.h"

namespace dstylize::test {
namespace {

class DeterminismTest : public AppTest {
  protected:
    std::string bytes_of(const Words& options, const std::string& out) {
        Words words{"in.png", out, "--style", "vine", "--detail", "96"};
        words.insert(words.end(), options.begin(), options.end());
        expect_done(run(words));
        return file_bytes(folder_ / out);
    }
};

TEST_F(DeterminismTest, TheSameCommandGivesTheSameBytesInEveryFormat) {
    for (const std::string format : {"png", "jpg", "tif", "webp", "svg", "pdf", "json"})
        EXPECT_TRUE(bytes_of({}, "a." + format) == bytes_of({}, "b." + format)) << format;
}

TEST_F(DeterminismTest, ThreadsChangeNothing) {
    for (const std::string format : {"png", "svg", "json"})
        EXPECT_TRUE(bytes_of({"--threads", "1"}, "a." + format) == bytes_of({"--threads", "2"}, "b." + format))
            << format;
}

TEST_F(DeterminismTest, AnotherSeedGivesAnotherDrawing) {
    EXPECT_FALSE(bytes_of({"--seed", "1"}, "a.json") == bytes_of({"--seed", "2"}, "b.json"));
}

TEST_F(DeterminismTest, TheOutputsSizeDoesNotChangeTheDrawing) {
    const auto drawing = [](const std::string& svg) { return svg.substr(svg.find("</metadata>")); };
    const auto skeleton = [](const std::string& json) { return json.substr(json.find("\"stages\"")); };
    EXPECT_TRUE(drawing(bytes_of({"--size", "A4"}, "a.svg")) == drawing(bytes_of({}, "b.svg")));
    EXPECT_TRUE(skeleton(bytes_of({"--size", "1000"}, "a.json")) == skeleton(bytes_of({}, "b.json")));
}

TEST_F(DeterminismTest, ALargerOutputIsTheSameDrawingFiner) {
    bytes_of({"--background", "#ffffff"}, "small.png");
    bytes_of({"--background", "#ffffff", "--size", "384"}, "large.png");
    const Picture small = read_picture(folder_ / "small.png").picture,
                  large = read_picture(folder_ / "large.png").picture;
    double difference = 0, contrast = 0;
    for (int y = 0; y < small.extent().y; ++y)
        for (int x = 0; x < small.extent().x; ++x) {
            double mean = 0;
            for (int j = 0; j < 4; ++j)
                for (int i = 0; i < 4; ++i) mean += large(4 * x + i, 4 * y + j).g / 16.0;
            difference += std::abs(mean - small(x, y).g);
            contrast += std::abs(255.0 - small(x, y).g);
        }
    EXPECT_LT(difference, 0.1 * contrast);
}

}  // namespace
}  // namespace dstylize::test
