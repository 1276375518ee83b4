// What is written: formats, sizes, grounds, metadata, and what is never overwritten.
#include <nlohmann/json.hpp>

#include "contract/app/app_fixture.h"
#include "formats/skeleton.h"

namespace dstylize::test {
namespace {

class OutputTest : public AppTest {
  protected:
    Picture drawn(const Words& options, const std::string& out = "out.png") {
        Words words{"in.png", out};
        words.insert(words.end(), options.begin(), options.end());
        expect_done(draw(words));
        return read_picture(folder_ / out).picture;
    }
};

TEST_F(OutputTest, EveryFormatOfOneRunHoldsTheDrawing) {
    expect_done(draw({"in.png", "a.png", "-o", "a.jpg", "-o", "a.tif", "-o", "a.webp", "-o", "a.svg", "-o", "a.pdf",
                      "-o", "a.json"}));
    const Picture png = read_picture(folder_ / "a.png").picture;
    EXPECT_EQ(read_picture(folder_ / "a.tif").picture, png);
    for (const std::string lossy : {"a.jpg", "a.webp"}) {
        const Picture other = read_picture(folder_ / lossy).picture;
        ASSERT_EQ(other.extent(), png.extent());
        double difference = 0;
        for (std::size_t n = 0; n < png.size(); ++n) difference += std::abs(int(png[n].g) - int(other[n].g));
        EXPECT_LT(difference / double(png.size()), 8) << lossy;
    }
    EXPECT_NE(file_bytes(folder_ / "a.svg").find("</svg>"), std::string::npos);
    EXPECT_TRUE(file_bytes(folder_ / "a.pdf").starts_with("%PDF"));
    const Skeleton skeleton = read_skeleton_json(file_bytes(folder_ / "a.json"));
    EXPECT_EQ(skeleton.picture, kSize);
    EXPECT_GT(skeleton.dendrite.size(), 100u);
}

TEST_F(OutputTest, StandardInputAndOutputServeAsFiles) {
    expect_done(draw({"in.png", "out.png"}));
    const Outcome piped = draw({"-", "-", "--format", "png"}, file_bytes(folder_ / "in.png"));
    EXPECT_EQ(piped.exit_code, 0) << piped.err;
    write_file(folder_ / "piped.png", piped.out);
    EXPECT_EQ(read_picture(folder_ / "piped.png").picture, read_picture(folder_ / "out.png").picture);
}

TEST_F(OutputTest, OneThingGoesToStandardOutput) {
    const Outcome outcome = draw({"in.png", "-", "--format", "png", "--json"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(nlohmann::json::parse(outcome.out)["error"]["exit_code"], 2);
    expect_error(draw({"in.png", "-", "--format", "png", "--recipe", "-"}), 2, {"standard output"});
}

TEST_F(OutputTest, SizesAreWhatTheySay) {
    const std::vector<std::pair<Words, Extent>> rows{
        {{}, {96, 64}},
        {{"--size", "48"}, {48, 32}},
        {{"--size", "300px"}, {300, 200}},
        {{"--size", "150%"}, {144, 96}},
        {{"--scale", "0.5"}, {48, 32}},
        {{"--size", "1in@90dpi"}, {90, 60}},
        {{"--size", "25.4mm@120"}, {120, 80}},
        {{"--size", "2.54cm"}, {300, 200}},
        {{"--size", "A6@50dpi"}, {291, 194}},  // 148 mm wide, and lower than 105
        {{"--size", "1"}, {1, 1}},
    };
    for (const auto& [options, size] : rows)
        EXPECT_EQ(drawn(options).extent(), size) << ::testing::PrintToString(options);
}

TEST_F(OutputTest, APaperIsTurnedAsThePictureIs) {
    write_png(folder_ / "tall.png", scene({60, 120}));
    expect_done(draw({"tall.png", "out.png", "--size", "A6@50dpi"}));
    EXPECT_EQ(read_picture(folder_ / "out.png").picture.extent(), (Extent{146, 291}));
}

TEST_F(OutputTest, ALengthIsTheResolutionOfPicturesAndThePageOfVectors) {
    expect_done(draw({"in.png", "a.png", "-o", "a.tif", "-o", "a.svg", "--size", "30mm@150dpi"}));
    EXPECT_NEAR(read_picture(folder_ / "a.png").metadata.dpi, 150, 0.1);
    EXPECT_NEAR(read_picture(folder_ / "a.tif").metadata.dpi, 150, 0.1);
    EXPECT_NE(file_bytes(folder_ / "a.svg").find("width=\"30mm\" height=\"20mm\""), std::string::npos);
}

TEST_F(OutputTest, ResolutionAuthorAndCopyrightAreKept) {
    PictureMetadata metadata;
    metadata.dpi = 240;
    metadata.text = {{"author", "Ada Ångström"}, {"copyright", "free to copy"}};
    write_picture(folder_ / "signed.tif", scene(kSize), metadata);
    for (const std::string out : {"a.png", "a.jpg", "a.tif"}) {
        expect_done(draw({"signed.tif", out}));
        const PictureMetadata kept = read_picture(folder_ / out).metadata;
        EXPECT_NEAR(kept.dpi, 240, 0.5) << out;
        EXPECT_EQ(kept.find("author"), "Ada Ångström") << out;
        EXPECT_EQ(kept.find("copyright"), "free to copy") << out;
    }
    expect_done(draw({"signed.tif", "a.svg"}));
    EXPECT_NE(file_bytes(folder_ / "a.svg").find("<dc:creator>Ada Ångström</dc:creator>"), std::string::npos);
}

TEST_F(OutputTest, GroundsAreWhatTheySay) {
    const Picture red = drawn({"--background", "#c00000", "--force"});
    const Picture none = drawn({"--background", "none", "--force"});
    const Picture over = drawn({"--background", "input", "--force"});
    const Picture in = read_picture(folder_ / "in.png").picture;
    std::size_t empty = 0;
    for (std::size_t n = 0; n < none.size(); ++n) {
        if (none[n].a != 0) continue;
        ++empty;
        ASSERT_EQ(red[n], (Rgba8{0xc0, 0, 0, 255}));
        ASSERT_EQ(over[n], in[n]);
    }
    EXPECT_GT(empty, none.size() / 10);
    EXPECT_LT(empty, none.size());
}

TEST_F(OutputTest, OtherGroundsReplaceTheStylesOwnPicture) {
    const auto stormy = [&](const std::string& background) {
        expect_done(
            run({"in.png", "storm.png", "--style", "storm", "--detail", "64", "--background", background, "--force"}));
        return read_picture(folder_ / "storm.png").picture;
    };
    const Picture none = stormy("none"), green = stormy("#00ff00");
    const auto corner = [](const Picture& picture) { return picture(1, picture.extent().y - 2); };
    EXPECT_LT(corner(none).a, 60) << "where no bolt is near";
    EXPECT_GT(corner(green).g, corner(green).r + 60);
}

TEST_F(OutputTest, ABackgroundPictureCoversTheFrame) {
    Picture tall = flat({40, 400}, {0, 0, 255, 255});
    for (int y = 180; y < 220; ++y)
        for (int x = 0; x < 40; ++x) tall(x, y) = {0, 200, 0, 255};  // all that the frame shows
    write_png(folder_ / "tall.png", tall);
    const Picture ground = drawn({"--background", "tall.png"}), none = drawn({"--background", "none"}, "none.png");
    for (std::size_t n = 0; n < none.size(); ++n)
        if (none[n].a == 0) {
            ASSERT_EQ(ground[n], (Rgba8{0, 200, 0, 255}));
        }
    expect_done(draw({"in.png", "a.svg", "-o", "a.pdf", "--background", "tall.png"}));
    EXPECT_NE(file_bytes(folder_ / "a.svg").find("data:image/png;base64,iVBORw0KGgo"), std::string::npos);
    EXPECT_NE(file_bytes(folder_ / "a.pdf").find("/Subtype /Image"), std::string::npos);
}

TEST_F(OutputTest, GrainIsOnlyOnSmallPictures) {
    const auto tones_of_the_corner = [](const Picture& picture) {
        int least = 255, most = 0;
        for (int y = 0; y < 6; ++y)
            for (int x = 0; x < 6; ++x) {
                least = std::min<int>(least, picture(x, y).b);
                most = std::max<int>(most, picture(x, y).b);
            }
        return most - least;
    };
    const Words grain{"--set", "ink.grain=0.2", "--set", "ink.paper=\"#808080\"", "--set", "lattice.margin=50"};
    Words small = grain, large = grain;
    small.insert(small.end(), {"--size", "300"});
    large.insert(large.end(), {"--size", "2500"});
    EXPECT_GT(tones_of_the_corner(drawn(small)), 3);
    EXPECT_EQ(tones_of_the_corner(drawn(large)), 0);
}

TEST_F(OutputTest, ShowMakesAPictureOfTheLatticesSize) {
    for (const std::string stage :
         {"importance", "weights", "endpoints", "distance", "owners", "tree", "flow", "tree:dendrite"})
        EXPECT_EQ(drawn({"--show", stage}).extent(), (Extent{64, 43})) << stage;
}

TEST_F(OutputTest, OurOwnFilesAreReplacedOthersOnlyByForce) {
    for (const std::string format : {"png", "jpg", "tif", "webp", "svg", "pdf", "json"}) {
        const std::string out = "out." + format;
        expect_done(draw({"in.png", out, "--no-recipe"}));
        const std::string first = file_bytes(folder_ / out);
        expect_done(draw({"in.png", out, "--seed", "2"}));
        EXPECT_NE(file_bytes(folder_ / out), first) << format;
    }
    write_png(folder_ / "theirs.png", scene(kSize));
    const std::string theirs = file_bytes(folder_ / "theirs.png");
    expect_error(draw({"in.png", "theirs.png"}), 4, {"theirs.png", "--force"});
    EXPECT_EQ(file_bytes(folder_ / "theirs.png"), theirs);
    expect_done(draw({"in.png", "theirs.png", "--force"}));
    EXPECT_NE(file_bytes(folder_ / "theirs.png"), theirs);
}

TEST_F(OutputTest, NoOutputIsWrittenWhenOneCannotBeMade) {
    const auto before = folder_.names();
    expect_error(draw({"in.png", "a.png", "-o", "a.webp", "--size", "17000", "--max-memory", "64G"}), 2, {"a.webp"});
    expect_error(draw({"in.png", "a.png", "-o", "no/b.png"}), 4, {"no/b.png"});
    EXPECT_EQ(folder_.names(), before);
}

TEST_F(OutputTest, InkNeedsLessMemoryThanATreeOnTheSameLattice) {
    const Words asks{"in.png", "a.png", "--dry-run", "--detail", "2000", "--max-memory", "512M", "--style"};
    const auto with = [&](const char* style) {
        Words words = asks;
        words.emplace_back(style);
        return run(words);
    };
    expect_done(with("ink"));
    expect_error(with("tree"), 2, {"in.png", "GiB", "--detail"});
}

TEST_F(OutputTest, AnInputNamedLikeASubcommandIsGivenWithItsFolder) {
    std::filesystem::rename(folder_ / "in.png", folder_ / "styles");
    expect_done(draw({"./styles", "out.png"}));
    EXPECT_EQ(read_picture(folder_ / "out.png").picture.extent(), kSize);
}

}  // namespace
}  // namespace dstylize::test
