// Every wrong command line: its exit code, its one line, and that nothing is written.
#include "contract/app/app_fixture.h"

namespace dstylize::test {
namespace {

struct WrongUsage {
    const char* name;
    Words words;
    Words says;
    int exit_code = 2;
};
// GoogleTest looks for a function of this name.
void PrintTo(const WrongUsage& c, std::ostream* out) { *out << c.name; }  // NOLINT(readability-identifier-naming)

class WrongUsageTest : public AppTest, public ::testing::WithParamInterface<WrongUsage> {};

TEST_P(WrongUsageTest, IsOneLineAndLeavesNothing) {
    write_file(folder_ / "photo.jpg", "somebody's photograph");
    write_file(folder_ / "two.csv", "0.5,0.5\nhere,there\n");
    write_file(folder_ / "far.csv", "0.5,0.5\n5000,3\n");
    write_file(folder_ / "stage.csv", "0.5,0.5,leaves\n");
    write_file(folder_ / "empty.csv", "# nothing\n");
    write_file(folder_ / "broken.toml", "[style]\nextends = \"ink\"\n[lattice]\ndetial = 100\n");
    write_file(folder_ / "syntax.toml", "[style]\nmetaphor = \n");
    write_png(folder_ / "black.png", flat({30, 20}, {0, 0, 0, 255}));
    Picture half = flat({96, 64}, {255, 255, 255, 255});
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 48; ++x) half(x, y) = {0, 0, 0, 255};
    write_png(folder_ / "half.png", half);
    std::filesystem::create_directory(folder_ / "folder");
    const auto before = folder_.names();

    expect_error(run(GetParam().words), GetParam().exit_code, GetParam().says);
    EXPECT_EQ(folder_.names(), before);
    EXPECT_EQ(file_bytes(folder_ / "photo.jpg"), "somebody's photograph");
}

const WrongUsage kWrong[] = {
    {"no_names", {}, {"no picture", "--help"}},
    {"no_output", {"in.png"}, {"no output", "-o"}},
    {"too_many_names", {"in.png", "a.png", "b.png"}, {"b.png", "-o"}},
    {"unknown_option", {"in.png", "out.png", "--stlye", "ink"}, {"--stlye", "did you mean '--style'?"}},
    {"unknown_short_option", {"in.png", "out.png", "-x"}, {"-x", "unknown option", "--help-all"}},
    {"unknown_style", {"in.png", "out.png", "--style", "vien"}, {"vien", "did you mean 'vine'?"}},
    {"missing_style_file", {"in.png", "out.png", "--style", "./no.toml"}, {"./no.toml", "cannot be read"}},
    {"style_file_with_unknown_key",
     {"in.png", "out.png", "--style", "broken.toml"},
     {"broken.toml:4:", "detial", "lattice.detail"}},
    {"style_file_with_bad_syntax", {"in.png", "out.png", "--style", "syntax.toml"}, {"syntax.toml:2:"}},
    {"set_without_value", {"in.png", "out.png", "--set", "stroke.smooth"}, {"stroke.smooth", "section.key=value"}},
    {"set_unknown_key", {"in.png", "out.png", "--set", "stroke.smoth=1"}, {"did you mean 'stroke.smooth'?"}},
    {"set_unknown_stage", {"in.png", "out.png", "--set", "stage.leaf.carry=1"}, {"stages are contours, tone"}},
    {"set_out_of_range", {"in.png", "out.png", "--set", "width.widest=1e9"}, {"width.widest", "out of range"}},
    {"set_wrong_type", {"in.png", "out.png", "--set", "width.widest=broad"}, {"width.widest", "not a number"}},
    {"detail_too_small", {"in.png", "out.png", "--detail", "5"}, {"--detail", "16"}},
    {"detail_no_number", {"in.png", "out.png", "--detail", "many"}, {"--detail"}},
    {"option_without_value", {"in.png", "out.png", "--detail"}, {"--detail"}},
    {"seed_negative", {"in.png", "out.png", "--seed", "-3"}, {"--seed"}},
    {"quality_out_of_range", {"in.png", "out.jpg", "--quality", "0"}, {"--quality"}},
    {"memory_too_small", {"in.png", "out.png", "--max-memory", "1M"}, {"--max-memory", "256M"}},
    {"size_nonsense", {"in.png", "out.png", "--size", "big"}, {"--size big", "30cm@300dpi"}},
    {"size_zero", {"in.png", "out.png", "--size", "0"}, {"--size 0"}},
    {"size_fraction", {"in.png", "out.png", "--size", "10.5"}, {"--size 10.5", "whole number"}},
    {"size_unit", {"in.png", "out.png", "--size", "3ft"}, {"unknown unit 'ft'"}},
    {"size_dpi", {"in.png", "out.png", "--size", "30cm@fine"}, {"--size 30cm@fine"}},
    {"size_and_scale", {"in.png", "out.png", "--size", "300", "--scale", "2"}, {"--size", "--scale"}},
    {"size_enormous", {"in.png", "out.png", "--size", "100km"}, {"--size"}},
    {"size_past_the_limit", {"in.png", "out.png", "--size", "90000"}, {"90000", "65535"}},
    {"size_past_memory", {"in.png", "out.png", "--size", "60000"}, {"in.png", "GiB", "--max-memory"}},
    {"size_past_webp", {"in.png", "out.webp", "--size", "17000", "--max-memory", "64G"}, {"out.webp", "16383"}},
    {"detail_past_memory", {"in.png", "out.png", "--detail", "16384"}, {"in.png", "GiB", "--detail"}},
    {"unknown_extension", {"in.png", "out.xyz"}, {"out.xyz", "svg"}},
    {"no_extension", {"in.png", "out"}, {"out", "--format"}},
    {"unknown_format", {"in.png", "out", "--format", "gif"}, {"gif", "webp"}},
    {"format_against_extension", {"in.png", "out.jpg", "--format", "png"}, {"out.jpg", "--format says png"}},
    {"standard_output_without_format", {"in.png", "-"}, {"standard output", "--format"}},
    {"quiet_and_verbose", {"in.png", "out.png", "--quiet", "--verbose"}, {"--quiet", "--verbose"}},
    {"output_is_the_input", {"in.png", "./in.png", "--force"}, {"./in.png", "is also an input"}},
    {"output_is_the_mask", {"in.png", "half.png", "--mask", "half.png", "--force"}, {"half.png", "is also an input"}},
    {"output_named_twice", {"in.png", "out.png", "-o", "./out.png"}, {"./out.png", "twice"}},
    {"output_is_a_folder", {"in.png", "folder"}, {"folder", "is a folder"}},
    {"input_is_a_folder", {"folder", "out.png"}, {"out.png", "names a file", "folder"}},
    {"transparent_jpeg", {"in.png", "out.jpg", "--background", "none"}, {"out.jpg", "transparent"}},
    {"background_no_colour", {"in.png", "out.png", "--background", "#12"}, {"--background #12"}},
    {"background_missing", {"in.png", "out.png", "--background", "no.png"}, {"no.png", "no such file"}, 3},
    {"place_without_picture", {"in.png", "out.png", "--place", "0.1,0.1,0.5,0.5"}, {"--place", "--background FILE"}},
    {"place_no_box",
     {"in.png", "out.png", "--background", "half.png", "--place", "0.5,0.5"},
     {"--place 0.5,0.5", "not a box"}},
    {"place_zero", {"in.png", "out.png", "--background", "half.png", "--place", "0.1,0.1,0,0.5"}, {"--place", "zero"}},
    {"place_negative", {"in.png", "out.png", "--background", "half.png", "--place=-1,0,5,5"}, {"--place", "negative"}},
    {"place_outside",
     {"in.png", "out.png", "--background", "half.png", "--place", "0.6,0.1,0.5,0.5"},
     {"--place", "outside the background", "96 x 64"}},
    {"place_larger_than_background",
     {"in.png", "out.png", "--background", "half.png", "--place", "0,0,500,500"},
     {"--place", "outside the background", "96 x 64"}},
    {"place_in_a_missing_picture",
     {"in.png", "out.png", "--background", "no.png", "--place", "0.1,0.1,0.5,0.5"},
     {"no.png", "no such file"},
     3},
    {"show_in_a_place",
     {"in.png", "out.png", "--background", "half.png", "--place", "0.1,0.1,0.5,0.5", "--show", "tone"},
     {"--show tone", "--place"}},
    {"place_past_memory",
     {"in.png", "out.png", "--background", "half.png", "--place", "0.1,0.1,0.5,0.5", "--size", "15000", "--max-memory",
      "3G"},
     {"GiB", "--size"}},
    {"blend_unknown", {"in.png", "out.png", "--blend", "burn"}, {"scene.blend", "burn", "multiply"}},
    {"show_unknown", {"in.png", "out.png", "--show", "importanse"}, {"did you mean 'importance'?"}},
    {"show_as_vectors", {"in.png", "out.svg", "--show", "tone"}, {"out.svg", "png"}},
    {"importance_mode_alone", {"in.png", "out.png", "--importance-mode", "replace"}, {"--importance FILE"}},
    {"importance_mode_unknown", {"in.png", "out.png", "--importance-mode", "add"}, {"--importance-mode"}},
    {"root_nonsense", {"in.png", "out.png", "--root", "left"}, {"--root left", "darkest"}},
    {"root_outside", {"in.png", "out.png", "--detail", "64", "--root", "1.5,0.5"}, {"in.png", "outside", "96 x 64"}},
    {"root_negative", {"in.png", "out.png", "--detail", "64", "--root", "-4,10"}, {"in.png", "outside"}},
    {"root_in_the_mask",
     {"in.png", "out.png", "--detail", "64", "--mask", "half.png", "--root", "0.2,0.5"},
     {"nothing may grow", "mask"}},
    {"mask_all_black",
     {"in.png", "out.png", "--detail", "64", "--mask", "black.png"},
     {"black.png", "nothing can grow"},
     1},
    {"mask_missing", {"in.png", "out.png", "--mask", "no.png"}, {"no.png", "no such file"}, 3},
    {"mask_no_picture", {"in.png", "out.png", "--mask", "two.csv"}, {"two.csv"}, 3},
    {"endpoints_missing", {"in.png", "out.png", "--endpoints", "no.csv"}, {"no.csv", "no such file"}, 3},
    {"endpoints_malformed", {"in.png", "out.png", "--endpoints", "two.csv"}, {"two.csv:2", "x,y"}, 3},
    {"endpoints_outside", {"in.png", "out.png", "--endpoints", "far.csv"}, {"far.csv", "outside", "96 x 64"}, 3},
    {"endpoints_of_no_stage", {"in.png", "out.png", "--endpoints", "stage.csv"}, {"stage.csv", "contours, tone"}, 3},
    {"endpoints_none", {"in.png", "out.png", "--endpoints", "empty.csv"}, {"empty.csv", "no endpoint"}, 3},
    {"output_exists", {"in.png", "photo.jpg"}, {"photo.jpg", "not made by dstylize", "--force"}, 4},
    {"output_in_no_folder", {"in.png", "nowhere/out.png"}, {"nowhere/out.png", "no folder nowhere"}, 4},
    {"output_to_a_full_device",
     {"in.png", "/dev/full", "--format", "png", "--detail", "64"},
     {"/dev/full", "space"},
     4},
    {"recipe_file_exists", {"in.png", "out.png", "--recipe", "photo.jpg"}, {"photo.jpg", "--force"}, 4},
    {"replay_one_name", {"replay", "in.png"}, {"replay", "OLD IN OUT"}},
    {"replay_without_recipe", {"replay", "in.png", "in.png", "out.png"}, {"in.png", "carries no recipe"}, 3},
    {"replay_missing", {"replay", "no.svg", "in.png", "out.png"}, {"no.svg", "no such file"}, 3},
    {"replay_takes_no_style",
     {"replay", "a.svg", "in.png", "out.png", "--style", "ink"},
     {"--style", "unknown option"}},
    {"styles_unknown", {"styles", "vien"}, {"did you mean 'vine'?"}},
    {"styles_two", {"styles", "vine", "ink"}, {"ink", "one name too many"}},
};

INSTANTIATE_TEST_SUITE_P(CommandLine, WrongUsageTest, ::testing::ValuesIn(kWrong),
                         [](const auto& row) { return std::string(row.param.name); });

}  // namespace
}  // namespace dstylize::test
