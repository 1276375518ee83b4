// Drawings of the samples against stored ones that somebody looked at. A change of look is made on
// purpose: DSTYLIZE_UPDATE_GOLDENS=1 stores the new ones, and CHANGELOG.md gets a line under "Looks".
//
// Filters of other processor generations round differently in the last bit, and a path may then take
// another equally good way; so structures are compared as sets of nodes and pictures after a blur.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "formats/files.h"
#include "formats/picture_codec.h"
#include "formats/skeleton.h"
#include "imaging/filters.h"
#include "pipeline/style_file.h"
#include "pipeline/stylize.h"
#include "render/raster.h"

namespace dstylize {
namespace {

struct Golden {
    const char *style, *sample;
    bool is_mask = false;  ///< the sample is also the mask
};
constexpr int kPictureDetail = 320, kStructureDetail = 128;

std::filesystem::path source(const std::string& path) { return std::filesystem::path(DSTYLIZE_SOURCE_DIR) / path; }
bool updating() { return std::getenv("DSTYLIZE_UPDATE_GOLDENS") != nullptr; }

class Goldens : public ::testing::TestWithParam<Golden> {
  protected:
    static CodecOptions codec_options() {
        CodecOptions options;
        options.program = DSTYLIZE_CODEC;
        return options;
    }
    PictureCodec codec_{codec_options()};

    Picture read_picture(const std::filesystem::path& path) {
        return codec_.decode(read_file(path, 1 << 26), path.string()).picture;
    }
    Drawing drawing(int detail) {
        const Picture sample = read_picture(source("samples/" + std::string(GetParam().sample) + ".png"));
        Controls controls;
        if (GetParam().is_mask) controls.mask = sample;
        return stylize(sample, load_style(GetParam().style, {{"lattice.detail", std::to_string(detail)}}), controls);
    }
    static std::filesystem::path stored(const std::string& kind, const std::string& extension) {
        return source("tests/golden/" + kind + "/" + GetParam().style + "-" + GetParam().sample + extension);
    }
};

TEST_P(Goldens, StructureIsTheStoredOne) {
    const Drawing d = drawing(kStructureDetail);
    const std::filesystem::path path = stored("structure", ".json");
    if (updating()) {
        // Positions are left out: they follow from the nodes.
        Dendrite at_nodes = d.dendrite;
        for (std::uint32_t v = 0; v < at_nodes.size(); ++v)
            at_nodes.position_lattice[v] = Lattice(d.lattice, {}).position_lattice(at_nodes.node[v]);
        const std::string json = skeleton_json({at_nodes, d.lattice, d.picture, d.stage_names, {}}, {});
        write_file_atomically(path, std::as_bytes(std::span(json)));
    }
    const std::vector<std::byte> bytes = read_file(path, 1 << 26);
    const Skeleton golden = read_skeleton_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    ASSERT_EQ(golden.lattice, d.lattice);
    const std::set<NodeId> now(d.dendrite.node.begin(), d.dendrite.node.end());
    const std::set<NodeId> then(golden.dendrite.node.begin(), golden.dendrite.node.end());
    std::vector<NodeId> both;
    std::set_intersection(now.begin(), now.end(), then.begin(), then.end(), std::back_inserter(both));
    EXPECT_GT(double(both.size()), 0.9 * double(std::max(now.size(), then.size())));
    for (std::uint32_t v = 0; v < golden.dendrite.size(); ++v)
        if (golden.dendrite.is_root(v)) {
            EXPECT_TRUE(now.contains(golden.dendrite.node[v])) << "a root moved";
        }
}

TEST_P(Goldens, PictureLooksLikeTheStoredOne) {
    constexpr float kBlur_px = 2, kMeanDifference = 0.02f, kLargestDifference = 0.25f;
    const Drawing d = drawing(kPictureDetail);
    const Picture picture = raster(d.list, {d.lattice}, {});
    const std::filesystem::path path = stored("picture", ".png");
    if (updating()) {
        EncodeOptions small;
        small.compression = 9;
        write_file_atomically(path, codec_.encode(picture, small, path.string()));
    }
    const Picture golden = read_picture(path);
    ASSERT_EQ(golden.extent(), picture.extent());
    const Grid<float> now = blurred(luma_plane(picture), kBlur_px), then = blurred(luma_plane(golden), kBlur_px);
    float sum = 0, largest = 0;
    for (std::size_t n = 0; n < now.size(); ++n) {
        sum += std::abs(now[n] - then[n]);
        largest = std::max(largest, std::abs(now[n] - then[n]));
    }
    EXPECT_LT(sum / float(now.size()), kMeanDifference);
    EXPECT_LT(largest, kLargestDifference);
}

INSTANTIATE_TEST_SUITE_P(Samples, Goldens,
                         ::testing::Values(Golden{"vine", "portrait"}, Golden{"vine", "still-life"},
                                           Golden{"ink", "cat"}, Golden{"lightning", "portrait"},
                                           Golden{"storm", "sky"}, Golden{"letters", "letters", true},
                                           Golden{"lichen-letters", "letters", true}, Golden{"tree", "cat"},
                                           Golden{"pareidolia", "portrait"}, Golden{"autumn", "portrait"}),
                         [](const auto& row) {
                             std::string name = std::string(row.param.style) + "_" + row.param.sample;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

}  // namespace
}  // namespace dstylize
