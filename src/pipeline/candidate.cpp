// Growths, smoothed and given widths, and the choice among several.
#include "pipeline/candidate.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "imaging/bands.h"
#include "imaging/filters.h"
#include "render/raster.h"

namespace dstylize {
namespace {

VariableStroke stroke_along(const Centreline& line, const Dendrite& dendrite, const Branch& branch,
                            const std::vector<float>& widths, const StrokeFrame& to) {
    constexpr float kHiddenInParent = 0.9f;
    VariableStroke stroke;
    stroke.order = branch.order;
    stroke.stage = dendrite.stage[branch.nodes.back()];
    for (const Vec2f p : line.points_lattice) stroke.points_px.push_back(to.px(p));
    const float first = widths[branch.nodes[0]],
                second = widths[branch.nodes[std::min<std::size_t>(1, branch.nodes.size() - 1)]];
    const bool joins = branch.parent_branch != Branch::kNone;
    const float at_joint = joins ? kHiddenInParent * std::min(first, second) : first;
    stroke.width_px.assign(line.lead, at_joint * to.width_scale);
    stroke.width_px.push_back(at_joint * to.width_scale);
    for (std::size_t k = 1; k < branch.nodes.size(); ++k)
        stroke.width_px.push_back(widths[branch.nodes[k]] * to.width_scale);
    return stroke;
}

}  // namespace

std::vector<VariableStroke> strokes(const std::vector<Centreline>& lines, const Dendrite& dendrite, const Branching& b,
                                    const std::vector<float>& widths, const StrokeFrame& to) {
    std::vector<VariableStroke> out(lines.size());
    const auto make = [&](std::size_t s) {
        out[s] = stroke_along(lines[s], dendrite, b.branches[lines[s].branch], widths, to);
    };
    each_index(lines.size(), make, kBandOfBranches);
    return out;
}

namespace {

/// The seed of one of several growths; the first has the run's own.
std::uint64_t growth_seed(std::uint64_t seed, int growth) { return seed + std::uint64_t(growth) * 0x9e3779b97f4a7c15u; }

/// Share of the cells of a grid over the lattice that the strokes ink.
Grid<float> drawn_ink(std::vector<VariableStroke> strokes_lattice, Extent lattice, Extent cells, const Work& work) {
    DisplayList list{float(lattice.x), float(lattice.y), {{1, 1, 1, 1}, 0, 0}, {}};
    Layer layer{"ink", Blend::max, {}};
    for (VariableStroke& stroke : strokes_lattice) {
        stroke.colour = {0, 0, 0, 1};
        layer.items.push_back(std::move(stroke));
    }
    list.layers.push_back(std::move(layer));
    // Finer ones make drawings that bench/look tells from these by 0.001 at most.
    constexpr int kSamplesPerCell = 2;
    constexpr float kFlatness_samples = 0.25f;
    const Picture black_on_white = raster(list, {cells, kSamplesPerCell, kFlatness_samples}, work);
    Grid<float> out(cells);
    std::transform(black_on_white.begin(), black_on_white.end(), out.begin(),
                   [](Rgba8 p) { return 1 - float(p.r) / 255; });
    return out;
}

/// Draws, compares the ink with the wanted tone, corrects, as often as the style says.
void fit_tone(Widths& widths, int passes, const std::vector<Centreline>& lines, const Dendrite& dendrite,
              const Branching& b, float u, const Work& work) {
    constexpr float kTargetWindow_u = 4, kDrawnWindow_u = 6;
    const Grid<float> target = blurred(widths.target_ink(), kTargetWindow_u * u);
    // The drawn ink is blurred: cells of two by two nodes say enough.
    const Extent lattice = target.extent(), cells{(lattice.x + 1) / 2, (lattice.y + 1) / 2};
    for (int pass = 0; pass < passes; ++pass) {
        work.check();
        const Grid<float> ink =
            drawn_ink(strokes(lines, dendrite, b, widths.widths(), {1, 1, 1}), lattice, cells, work);
        widths.correct(target, resized(blurred(ink, kDrawnWindow_u / 2 * u), lattice));
    }
}

Grid<float> weighted_sum(Fields& fields, const FieldWeights& weights) {
    Grid<float> out(fields.extent(), 0.0f);
    for (const auto& [name, weight] : weights) {
        const Grid<float>& field = fields[name];
        each_index(out.size(), [&, share = weight](std::size_t n) { out[n] += share * field[n]; });
    }
    return out;
}

Candidate candidate(PreparedPicture base, const Style& style, const Controls& controls, Extent picture_px,
                    const Work& work) {
    Candidate c{std::move(base), {}, {}, {}, {}};
    Fields& fields = c.base.fields;
    const float u = fields.u();
    c.grown = grow(c.base, style, controls, picture_px, {}, work);
    work.report("strokes", 0.75);
    Dendrite& dendrite = c.grown.dendrite;
    c.branching = branching(dendrite);
    smooth(dendrite, c.branching, int(std::lround(style.stroke.smooth * u * u)));
    warp(dendrite, fields.extent(), style.stroke, u, controls.seed);
    c.lines = centrelines(dendrite, c.branching, int(style.stroke.junction * u));
    Grid<float> width_sum, half_width;
    if (style.width.field > 0) width_sum = weighted_sum(fields, style.width.fields);
    if (style.width.room_share > 0) {
        half_width = fields["room"];
        transform(half_width, [whole = kRoom_u * u](float v) { return v * whole; });
    }
    const WidthParameters& p = style.width;
    const WidthFields look{.tone = p.wants_ink() || p.trunk > 0 ? &fields["wanted"] : nullptr,
                           .importance = fields["importance"],
                           .lines = p.wants_ink() ? &fields["lines"] : nullptr,
                           .sum = p.field > 0 ? &width_sum : nullptr,
                           .node_cost = p.path > 0 ? &c.grown.node_cost : nullptr,
                           .half_width = half_width.empty() ? nullptr : &half_width,
                           .guided = p.swing > 0 ? &fields["guided"] : nullptr};
    Widths widths(dendrite, c.branching, p, look, u);
    if (style.width.tone > 0) fit_tone(widths, style.width.feedback, c.lines, dendrite, c.branching, u, work);
    c.widths = widths.widths();
    return c;
}

/// How well a growth shows the picture: the correlation of its ink with the wanted one, where the picture
/// leads, thin lines (eyes, mouth) counting most.
double resemblance(Candidate& c, float window) {
    Fields& fields = c.base.fields;
    const Grid<float>&leads = fields["guided"], &lines = fields["lines"], &features = fields["features"];
    const Grid<float> wanted = blurred(fields["wanted"], window);
    const Grid<float> ink = ink_coverage(c.grown.dendrite, c.widths, fields.extent(), window);
    double n = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
    for (std::size_t k = 0; k < ink.size(); ++k) {
        const double weight = double(leads[k]) * (0.1 + double(lines[k]) + double(features[k]));
        const auto a = double(wanted[k]), b = double(ink[k]);
        n += weight, x += weight * a, y += weight * b;
        xx += weight * a * a, yy += weight * b * b, xy += weight * a * b;
    }
    const double spread = (n * xx - x * x) * (n * yy - y * y);
    return spread > 0 ? (n * xy - x * y) / std::sqrt(spread) : 0;
}

}  // namespace

std::uint64_t best_seed(const Picture& picture, const Style& style, const Controls& controls, const Work& work) {
    // Half the detail ranks growths much as the whole does, at a quarter of the cost.
    constexpr float kPreview = 0.5f;
    if (style.choice.growths == 1 || !controls.endpoints.empty()) return controls.seed;
    PreparedPicture first = prepared_picture(picture, style, controls, work, nullptr, kPreview);
    for (const char* needed_by_all : {"importance", "features"}) first.fields[needed_by_all];
    std::vector<double> score(static_cast<std::size_t>(style.choice.growths));
    Work quiet = work;
    quiet.progress = nullptr;
    tbb::parallel_for(std::size_t{0}, score.size(), [&](std::size_t k) {
        Controls own = controls;
        own.seed = growth_seed(controls.seed, int(k));
        Candidate c = candidate(prepared_picture(picture, style, own, quiet, &first, kPreview), style, own,
                                picture.extent(), quiet);
        score[k] = resemblance(c, style.choice.window * c.base.fields.u());
    });
    return growth_seed(controls.seed, int(std::max_element(score.begin(), score.end()) - score.begin()));
}

Candidate best_candidate(const Picture& picture, const Style& style, const Controls& controls, const Work& work) {
    Controls chosen = controls;
    chosen.seed = best_seed(picture, style, controls, work);
    return candidate(prepared_picture(picture, style, chosen, work), style, chosen, picture.extent(), work);
}

}  // namespace dstylize
