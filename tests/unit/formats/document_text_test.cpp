#include "formats/document_text.h"

#include <gtest/gtest.h>

#include "formats/document.h"
#include "formats/skeleton.h"

namespace dstylize {
namespace {

const std::string kText = "[recipe]\nname = \"a & b <c>\" # 'é' 漢 😀\nend = ]]>\ttab\n";

DocumentInfo info() { return {0, 0, "title", {{"author", "Ada"}, {"recipe", kText}}, {}}; }
DisplayList empty_list() { return {40, 30, {}, {}}; }

TEST(DocumentText, EveryDocumentGivesTheRecipeBack) {
    const std::string svg = svg_document(empty_list(), info()), pdf = pdf_document(empty_list(), info());
    Skeleton skeleton;
    skeleton.lattice = skeleton.picture = {4, 3};
    const std::string json = skeleton_json(skeleton, info());
    for (const std::string& document : {svg, pdf, json}) {
        EXPECT_TRUE(is_document(document));
        EXPECT_EQ(document_text(document, "recipe"), kText) << document.substr(0, 8);
    }
    EXPECT_EQ(document_text(svg, "author"), "Ada");
    EXPECT_EQ(document_text(json, "author"), "Ada");
    EXPECT_EQ(document_text(svg, "none"), "");
}

TEST(DocumentText, NumericReferencesAreUnderstood) {
    EXPECT_EQ(document_text("<svg><d:text key=\"recipe\">&#x41;&#66;&apos;&#128512;</d:text></svg>", "recipe"), "AB'😀");
}

TEST(DocumentText, DamageGivesNothing) {
    const std::string svg = svg_document(empty_list(), info()), pdf = pdf_document(empty_list(), info());
    EXPECT_EQ(document_text(svg.substr(0, svg.find("</d:text>", svg.find("recipe"))), "recipe"), "");
    EXPECT_EQ(document_text(pdf.substr(0, pdf.find("/Keywords")), "recipe"), "");
    for (const char* damaged :
         {"<svg><d:text key=\"recipe\">&nothing;</d:text>", "<svg><d:text key=\"recipe\">a & b</d:text>",
          "<svg><d:text key=\"recipe\">&#x110000;</d:text>", "{\"info\": {\"recipe\": 3}}", "{\"info\": 3}", "{",
          "%PDF /Keywords <FEFFDC00>", "%PDF /Keywords <FEFFzzzz>"})
        EXPECT_EQ(document_text(damaged, "recipe"), "") << damaged;
}

TEST(DocumentText, PicturesAreNoDocuments) {
    for (const char* picture : {"", "\x89PNG\r\n", "II*", "GIF89a", "P6 1 1 255 x"}) EXPECT_FALSE(is_document(picture));
}

}  // namespace
}  // namespace dstylize
