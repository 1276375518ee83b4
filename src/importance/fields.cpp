#include "importance/fields.h"

#include <algorithm>

#include "core/error.h"
#include "importance/detail_field_functions.h"

namespace dstylize {
namespace {

struct Row {
    std::string_view name;
    Grid<float> (*function)(Fields&);
    std::string_view meaning;
};
constexpr Row kRows[] = {
#define DSTYLIZE_FIELD(name, function, meaning) {name, &field::function, meaning},
#include "importance/fields.def"
#undef DSTYLIZE_FIELD
};
constexpr auto kNames = [] {
    std::array<std::string_view, std::size(kRows)> names{};
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = kRows[i].name;
    return names;
}();

std::size_t row_of(std::string_view name) {
    const auto at = std::find(kNames.begin(), kNames.end(), name);
    if (at == kNames.end())
        throw Error(ErrorCode::bad_usage, "", "no field is called '" + std::string(name) + "'",
                    "`dstylize styles --fields` lists them");
    return std::size_t(at - kNames.begin());
}

}  // namespace

Fields::Fields(Grid<float> luma, FieldParameters parameters, UserMaps maps, std::uint64_t seed,
               std::optional<float> nodes_per_u)
    : luma_(std::move(luma)),
      parameters_(parameters),
      maps_(std::move(maps)),
      seed_(seed),
      u_(nodes_per_u.value_or(float(luma_.extent().long_side()) / 1024)) {}

std::span<const std::string_view> Fields::names() { return kNames; }
std::string_view Fields::meaning(std::string_view name) { return kRows[row_of(name)].meaning; }

const Grid<float>& Fields::operator[](std::string_view name) {
    const std::size_t row = row_of(name);
    if (!cache_[row]) cache_[row] = kRows[row].function(*this);
    return *cache_[row];
}

void Fields::replace(std::string_view name, Grid<float> field) { cache_[row_of(name)] = std::move(field); }

void Fields::release(std::span<const std::string_view> names) {
    for (const std::string_view name : names) cache_[row_of(name)].reset();
}

void Fields::share(const Fields& other) {
    for (const std::string_view name :
         {"luma", "lightness", "darkness", "tone", "gradient", "lines", "importance", "features"})
        cache_[row_of(name)] = other.cache_[row_of(name)];
}

const FlowField& Fields::flow() {
    if (!flow_) flow_ = field::flow(*this);
    return *flow_;
}

const Grid<std::uint8_t>& Fields::shape_axis() {
    if (!shape_axis_) shape_axis_ = field::shape_axis(*this);
    return *shape_axis_;
}

const Grid<std::uint8_t>& Fields::shape_interior() {
    if (!shape_interior_) shape_interior_ = field::shape_interior(*this);
    return *shape_interior_;
}

void FieldParameters::visit(ParameterVisitor& v) {
    v.number({"stretch_low", "%", "luma percentile that becomes black"}, stretch_low, 0, 49);
    v.number({"stretch_high", "%", "luma percentile that becomes white"}, stretch_high, 51, 100);
    v.flag({"bright", "", "draw the light parts instead of the dark ones"}, bright);
    v.number({"tone_contrast", "", "share of an S-shaped curve in the tone"}, tone_contrast, 0, 1);
    v.number({"tone_equalise", "", "share of histogram equalisation in the tone"}, tone_equalise, 0, 1);
    v.number({"tone_local", "", "share of the surroundings' tone that is taken away: wide bright skies go dark"},
             tone_local, 0, 1);
    v.number({"tone_local_scale", "u", "size of those surroundings"}, tone_local_scale, 10, 500);
    v.number({"tone_white", "", "tone at and below this stays paper"}, tone_white, 0, 0.5f);
    v.number({"tone_black", "", "tone at and above this is fully inked"}, tone_black, 0.5f, 1);
    v.number({"gradient_scale", "u", "blur before the fine gradient"}, gradient_scale, 0.3f, 20);
    v.number({"gradient_wide_scale", "u", "blur before the wide gradient"}, gradient_wide_scale, 0.3f, 40);
    v.number({"gradient_wide_share", "", "weight of the wide gradient, 0: none"}, gradient_wide_share, 0, 1);
    v.number({"gradient_percentile", "%", "gradient percentile that counts as 1"}, gradient_percentile, 50, 100);
    v.number({"gradient_gamma", "", "below 1 lifts weak gradients"}, gradient_gamma, 0.2f, 3);
    v.number({"gradient_tone", "", "how much the gradient fades where no tone is wanted: one-sided contours"},
             gradient_tone, 0, 1);
    v.number({"line_scale", "u", "half width of the thin lines that are looked for"}, line_scale, 0.5f, 10);
    v.number({"importance_gradient", "", "weight of the gradient in the importance"}, importance_gradient, 0, 10);
    v.number({"importance_tone", "", "weight of the tone in the importance"}, importance_tone, 0, 10);
    v.number({"importance_lines", "", "weight of the lines in the importance"}, importance_lines, 0, 10);
    v.number({"importance_percentile", "%", "percentile that counts as 1; 100: the sum as it is"},
             importance_percentile, 50, 100);
    v.number({"features_gradient", "", "weight of the gradient against the lines"}, features_gradient, 0, 1);
    v.number({"features_surround", "u", "size of the surroundings that suppress textures"}, features_surround, 2, 100);
    v.number({"features_suppress", "", "how much busy surroundings suppress a feature"}, features_suppress, 0, 1);
    v.number({"avoid_scale", "u", "size of the bright details to keep clean"}, avoid_scale, 1, 60);
    v.number({"avoid_level", "", "how much brighter than around a detail must be; lower keeps more clean"}, avoid_level,
             0.3f, 1);
    v.number({"border_width", "u", "how far inside the frame growth is discouraged"}, border_width, 1, 100);
    v.number({"smooth_noise_scale", "u", "correlation length of the smooth noise"}, smooth_noise_scale, 0.5f, 60);
    v.number({"flow_fine", "u", "window of the fine structure tensor"}, flow_fine, 1, 60);
    v.number({"flow_coarse", "u", "window of the coarse structure tensor"}, flow_coarse, 2, 200);
    v.number({"flow_coarse_share", "", "weight of the coarse tensor: carries form into flat areas"}, flow_coarse_share,
             0, 4);
    v.number({"flow_swirl", "", "curls in areas without direction of their own"}, flow_swirl, 0, 4);
    v.number({"shape_overflow", "u", "how far growth in the mask may leave it"}, shape_overflow, 0, 60);
    v.number({"shape_ragged", "u", "how far the outline wanders inwards from there"}, shape_ragged, 0, 60);
    v.number({"shape_ragged_scale", "u", "correlation length of that wandering"}, shape_ragged_scale, 1, 200);
    v.number({"axis_width", "u", "how far from the shape's medial axis the field `axis` reaches"}, axis_width, 0.5f,
             200);
    v.number({"rim_width", "u", "how deep from the outline the field `rim` is above one half"}, rim_width, 0.5f, 60);
    v.number({"calm_scale", "u", "how far from contours calm areas stay"}, calm_scale, 5, 200);
    v.number({"calm_detail", "", "most detail that counts as calm"}, calm_detail, 0, 1);
    v.number({"calm_tone", "", "darkest tone that counts as calm"}, calm_tone, 0, 1);
}

}  // namespace dstylize
