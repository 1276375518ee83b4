#include <gtest/gtest.h>

#include <locale>
#include <regex>
#include <set>

#include "formats/document.h"
#include "render/raster.h"
#include "unit/formats/rendered.h"
#include "unit/formats/test_drawing.h"

namespace dstylize {
namespace {

using support::Difference;
using support::many_strokes;
using support::outcome_of;
using support::Scratch;
using support::test_drawing;

const DocumentInfo kInfo{
    0,
    0,
    "Vine <1> & \"more\"",
    {{"author", "Zoë Ünal"}, {"copyright", "CC0"}, {"recipe", "[style]\nname = \"vine\" # <&> ]]>\n"}}};

Picture svg_rendered(const DisplayList& list, int width, const DocumentInfo& info = {}) {
    const Scratch scratch;
    const std::string svg = scratch.write("a.svg", svg_document(list, info)), png = scratch.path("a.png");
    const auto run = outcome_of("rsvg-convert --width=" + std::to_string(width) + " -o " + png + " " + svg);
    EXPECT_EQ(run.status, 0) << run.output;
    return support::read_png(png);
}

Picture pdf_rendered(const DisplayList& list, int width, int height) {
    const Scratch scratch;
    const std::string pdf = scratch.write("a.pdf", pdf_document(list, {})), png = scratch.path("a");
    const auto run = outcome_of("pdftocairo -png -singlefile -transp -scale-to-x " + std::to_string(width) +
                                " -scale-to-y " + std::to_string(height) + " " + pdf + " " + png);
    EXPECT_EQ(run.status, 0) << run.output;
    return support::read_png(png + ".png");
}

std::string xpath(const std::string& svg, const std::string& expression) {
    const Scratch scratch;
    std::string text = outcome_of("xmllint --xpath '" + expression + "' " + scratch.write("a.svg", svg)).output;
    if (!text.empty() && text.back() == '\n') text.pop_back();
    return text;
}

/// Of 255. Viewers lay each stroke's soft edge over the last one's and the raster keeps the larger, so
/// single pixels where strokes meet differ more than the whole.
void expect_agreement(const Picture& viewer, const Picture& ours) {
    const Difference d = support::difference(viewer, ours);
    EXPECT_LT(d.rms, 2);
    EXPECT_LT(std::abs(d.mean), 0.5);
    EXPECT_LT(d.worst, 60);
}

TEST(SvgDocument, LibrsvgPaintsItLikeTheRaster) {
    const DisplayList list = test_drawing();
    for (const int scale : {1, 3})
        expect_agreement(svg_rendered(list, 320 * scale), raster(list, {{320 * scale, 240 * scale}}, {}));
}

TEST(PdfDocument, PopplerPaintsItLikeTheRaster) {
    const DisplayList list = test_drawing();
    for (const int scale : {1, 3})
        expect_agreement(pdf_rendered(list, 320 * scale, 240 * scale), raster(list, {{320 * scale, 240 * scale}}, {}));
}

TEST(VectorDocuments, LightIsScreenedOverWhatLiesBelow) {
    DisplayList list = test_drawing();
    list.paper.colour = {0.5f, 0.3f, 0.2f, 1};
    Glow glow;
    glow.core = {0.5f, 0.7f, 1, 1};
    const auto exposed = [&](float light) { return 1 - std::exp(-glow.exposure * light); };
    Layer light{"light", Blend::max, {}, glow};
    light.items.push_back(VariableStroke{{{20, 200}, {150, 90}, {300, 40}},
                                         {20, 14, 8},
                                         {exposed(glow.core.r), exposed(glow.core.g), exposed(glow.core.b), 1},
                                         0,
                                         0});
    list.layers = {light};
    const Picture wanted = raster(list, {{640, 480}}, {});
    EXPECT_GT(wanted(300, 180).b, 180);
    expect_agreement(svg_rendered(list, 640), wanted);
    expect_agreement(pdf_rendered(list, 640, 480), wanted);
}

class Mixed : public ::testing::TestWithParam<Mixing> {};
INSTANTIATE_TEST_SUITE_P(Blends, Mixed,
                         ::testing::Values(Mixing::over, Mixing::multiply, Mixing::screen, Mixing::soft_light));

TEST_P(Mixed, ViewersBlendLikeTheRaster) {
    DisplayList list = test_drawing();
    list.mixing = GetParam();
    list.paper.colour = {0.7f, 0.45f, 0.3f, 1};
    for (Item& item : list.layers[1].items) std::get<VariableStroke>(item).colour = {0.25f, 0.6f, 0.8f, 1};
    const Picture wanted = raster(list, {{640, 480}}, {});
    expect_agreement(svg_rendered(list, 640), wanted);
    expect_agreement(pdf_rendered(list, 640, 480), wanted);
    list.mixing = Mixing::over;
    const double without = support::difference(raster(list, {{640, 480}}, {}), wanted).rms;
    EXPECT_TRUE(GetParam() == Mixing::over ? without == 0 : without > 5) << without;
}

TEST_P(Mixed, BetweenLayersOfLightPaintIsBlendedWithAllBelow) {
    DisplayList list = test_drawing();
    list.mixing = GetParam();
    list.paper.colour = {0.5f, 0.4f, 0.3f, 1};
    Glow glow;
    glow.core = {0.3f, 0.2f, 0.1f, 1};
    const auto exposed = [&](float light) { return 1 - std::exp(-glow.exposure * light); };
    Layer light{"light", Blend::max, {}, glow};
    light.items.push_back(VariableStroke{{{20, 200}, {150, 90}, {300, 40}},
                                         {20, 14, 8},
                                         {exposed(glow.core.r), exposed(glow.core.g), exposed(glow.core.b), 1}});
    list.layers.insert(list.layers.begin() + 1, std::move(light));
    const Picture wanted = raster(list, {{640, 480}}, {});
    expect_agreement(svg_rendered(list, 640), wanted);
    expect_agreement(pdf_rendered(list, 640, 480), wanted);
}

TEST_P(Mixed, OnNoPaperPaintIsItself) {
    DisplayList list = test_drawing();
    list.paper.colour.a = 0;
    list.mixing = GetParam();
    for (const Picture& p : {raster(list, {{320, 240}}, {}), svg_rendered(list, 320), pdf_rendered(list, 320, 240)}) {
        EXPECT_EQ(p(2, 2).a, 0);
        EXPECT_NEAR(p(61, 200).r, 31, 1);
        EXPECT_NEAR(p(61, 200).g, 38, 1);
        EXPECT_EQ(p(61, 200).a, 255);
    }
}

TEST_P(Mixed, TheCoverLiesOverEverythingUnblended) {
    DisplayList list = test_drawing();
    list.mixing = GetParam();
    Picture cover({320, 240}, {0, 0, 0, 0});  // opaque below, then half transparent, clear above
    for (int y = 120; y < 240; ++y)
        for (int x = 0; x < 320; ++x) cover(x, y) = {200, std::uint8_t(x / 2), 40, std::uint8_t(y < 180 ? 128 : 255)};
    list.cover = std::make_shared<Picture>(cover);
    const Picture wanted = raster(list, {{320, 240}}, {});
    EXPECT_EQ(wanted(61, 200), cover(61, 200));
    DocumentInfo info;
    info.cover_png = support::png_file(cover);
    expect_agreement(svg_rendered(list, 320, info), wanted);
    expect_agreement(pdf_rendered(list, 320, 240), wanted);
}

TEST(SvgDocument, TransparentPaperStaysTransparent) {
    DisplayList list = test_drawing();
    list.paper.colour.a = 0;
    EXPECT_EQ(svg_document(list, {}).find("<rect"), std::string::npos);
    const Picture p = svg_rendered(list, 320);
    EXPECT_EQ(p(2, 2).a, 0);
    EXPECT_EQ(p(61, 200).a, 255);
}

TEST(PdfDocument, TransparentPaperStaysTransparent) {
    DisplayList list = test_drawing();
    list.paper.colour.a = 0;
    const Picture p = pdf_rendered(list, 320, 240);
    EXPECT_EQ(p(2, 2).a, 0);
    EXPECT_EQ(p(61, 200).a, 255);
}

TEST(SvgDocument, IsWellFormedXmlWhateverTheTextsSay) {
    const Scratch scratch;
    DocumentInfo info = kInfo;
    info.text.push_back({"odd \"key\" <&",
                         std::string("bad utf-8 \xff\xc0\x80\xed\xa0\x80 control \x01\x1b null ") + '\0' + " end\r\n"});
    DisplayList list = test_drawing();
    list.layers[0].name = "\"<&>' \xff";
    const auto run = outcome_of("xmllint --noout " + scratch.write("a.svg", svg_document(list, info)));
    EXPECT_EQ(run.status, 0) << run.output;
    EXPECT_EQ(run.output, "");
}

TEST(SvgDocument, TextsComeBackAsTheyWere) {
    const std::string svg = svg_document(test_drawing(), kInfo);
    EXPECT_EQ(xpath(svg, "string(/*/*[local-name()=\"title\"])"), kInfo.title);
    EXPECT_EQ(xpath(svg, "string(//*[local-name()=\"creator\"])"), "Zoë Ünal");
    EXPECT_EQ(xpath(svg, "string(//*[local-name()=\"rights\"])"), "CC0");
    EXPECT_EQ(xpath(svg, "string(//*[local-name()=\"text\"][@key=\"recipe\"])"), kInfo.text[2].second);
}

TEST(SvgDocument, SizesAreMillimetresOrPixels) {
    DocumentInfo info;
    const std::string px = svg_document(test_drawing(), info);
    EXPECT_EQ(xpath(px, "string(/*/@width)"), "320");
    EXPECT_EQ(xpath(px, "string(/*/@viewBox)"), "0 0 320 240");
    info.width_mm = 420.5;
    const std::string mm = svg_document(test_drawing(), info);
    EXPECT_EQ(xpath(mm, "string(/*/@width)"), "420.5mm");
    EXPECT_EQ(xpath(mm, "string(/*/@height)"), "315.38mm");
    EXPECT_EQ(xpath(mm, "string(/*/@viewBox)"), "0 0 320 240");
}

TEST(SvgDocument, GroupsFollowLayersStagesAndOrders) {
    const std::string svg = svg_document(test_drawing(), {});
    EXPECT_EQ(xpath(svg, "count(/*/*[local-name()=\"g\"])"), "4");  // the paper and three layers
    EXPECT_EQ(xpath(svg, "count(//*[local-name()=\"g\"][@*[local-name()=\"groupmode\"]=\"layer\"])"), "11");
    EXPECT_EQ(xpath(svg, "string(//*[@id=\"strokes-stage-1-order-1\"]/@*[local-name()=\"label\"])"), "stage 1 order 1");
    EXPECT_EQ(xpath(svg, "count(//*[@id=\"strokes-stage-1-order-1\"]/*[local-name()=\"path\"])"), "10");
    EXPECT_EQ(xpath(svg, "string(//*[@id=\"wash---glaze\"]/@opacity)"), "0.500");
    EXPECT_EQ(xpath(svg, "count(//*[local-name()=\"path\"])"), "57");
}

TEST(SvgDocument, IdsAreUnique) {
    DisplayList list = test_drawing();
    list.layers.push_back(list.layers[1]);
    for (Item& item : list.layers[2].items) std::get<VariableStroke>(item).order = 0;
    const std::string svg = svg_document(list, {});
    std::set<std::string> ids;
    const std::regex id(" id=\"([^\"]*)\"");
    for (std::sregex_iterator it(svg.begin(), svg.end(), id), end; it != end; ++it)
        EXPECT_TRUE(ids.insert((*it)[1]).second) << (*it)[1];
    EXPECT_GT(ids.size(), 10u);
}

TEST(SvgDocument, LayersOfSeveralColoursKeepPaintingOrder) {
    DisplayList list{60, 60, {}, {}};
    const Rgba red{1, 0, 0, 1}, blue{0, 0, 1, 1};
    list.layers = {{"ink",
                    Blend::max,
                    {VariableStroke{{{5, 30}, {55, 30}}, {10, 10}, red, 5, 1},
                     VariableStroke{{{30, 5}, {30, 55}}, {10, 10}, blue, 0, 0}}}};
    EXPECT_EQ(svg_rendered(list, 60)(30, 30), (Rgba8{0, 0, 255, 255}));
    EXPECT_EQ(raster(list, {{60, 60}}, {})(30, 30), (Rgba8{0, 0, 255, 255}));
}

TEST(SvgDocument, StaysSmall) {
    // A full vine of 25,000 such strokes stays below 12 MB.
    EXPECT_LT(double(svg_document(many_strokes(1000, 20), {}).size()) / 1000, 12e6 / 25000);
}

TEST(VectorDocuments, DoNotDependOnTheLocale) {
    struct Comma : std::numpunct<char> {
        char do_decimal_point() const override { return ','; }
        char do_thousands_sep() const override { return '.'; }
        std::string do_grouping() const override { return "\3"; }
    };
    DisplayList list = many_strokes(20, 20);
    list.width_px = 2048.5f;
    const std::string svg = svg_document(list, kInfo), pdf = pdf_document(list, kInfo);
    const std::locale before = std::locale::global(std::locale(std::locale(), new Comma));
    const std::string svg_there = svg_document(list, kInfo), pdf_there = pdf_document(list, kInfo);
    std::locale::global(before);
    EXPECT_EQ(svg_there, svg);
    EXPECT_EQ(pdf_there, pdf);
}

TEST(VectorDocuments, OfAnEmptyListAreValid) {
    const DisplayList list{10, 20, {}, {{"nothing", Blend::max, {VariableStroke{}, Fill{}}}}};
    EXPECT_EQ(svg_rendered(list, 10).extent(), (Extent{10, 20}));
    EXPECT_EQ(pdf_rendered(list, 10, 20).extent(), (Extent{10, 20}));
}

TEST(PdfDocument, SameListSameBytes) {
    const std::string first = pdf_document(test_drawing(), kInfo);
    EXPECT_EQ(first, pdf_document(test_drawing(), kInfo));
    EXPECT_NE(first.find("/CreationDate (19700101000000Z"), std::string::npos);
}

TEST(PdfDocument, SaysWhatItIs) {
    const Scratch scratch;
    DocumentInfo info = kInfo;
    info.width_mm = 420;
    const std::string said = outcome_of("pdfinfo " + scratch.write("a.pdf", pdf_document(test_drawing(), info))).output;
    EXPECT_NE(said.find("Vine <1> & \"more\""), std::string::npos) << said;
    EXPECT_NE(said.find("Zoë Ünal"), std::string::npos) << said;
    EXPECT_NE(said.find("copyright: CC0"), std::string::npos) << said;
    EXPECT_NE(said.find("[style]\nname = \"vine\" # <&> ]]>"), std::string::npos) << said;
    EXPECT_NE(said.find("1190.55 x 892.913 pts"), std::string::npos) << said;
}

TEST(PdfDocument, PixelsAreAt96DotsAnInch) {
    const Scratch scratch;
    const std::string said = outcome_of("pdfinfo " + scratch.write("a.pdf", pdf_document(test_drawing(), {}))).output;
    EXPECT_NE(said.find("240 x 180 pts"), std::string::npos) << said;
}

}  // namespace
}  // namespace dstylize
