#include "pipeline/stylize.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "imaging/filters.h"
#include "pipeline/growth.h"
#include "pipeline/prepared_picture.h"
#include "render/raster.h"

namespace dstylize {
namespace {

/// The seed of one of several growths; the first has the run's own.
std::uint64_t growth_seed(std::uint64_t seed, int growth) { return seed + std::uint64_t(growth) * 0x9e3779b97f4a7c15u; }

/// Lattice frame to picture frame.
struct Frame {
    float x_scale, y_scale, width_scale;
    Vec2f px(Vec2f p) const { return {p.x * x_scale, p.y * y_scale}; }
};
Frame frame(Extent lattice, Extent picture) {
    const float x = float(picture.x) / float(lattice.x), y = float(picture.y) / float(lattice.y);
    // A side of one node says nothing about the scale.
    return {x, y, lattice.x >= lattice.y ? x : y};
}

std::vector<VariableStroke> strokes(const std::vector<Centreline>& lines, const Dendrite& dendrite, const Branching& b,
                                    const std::vector<float>& widths, const Frame& to) {
    constexpr float kHiddenInParent = 0.9f;
    std::vector<VariableStroke> out(lines.size());
    for (std::size_t s = 0; s < lines.size(); ++s) {
        const Branch& branch = b.branches[lines[s].branch];
        VariableStroke& stroke = out[s];
        stroke.order = branch.order;
        stroke.stage = dendrite.stage[branch.nodes.back()];
        for (const Vec2f p : lines[s].points_lattice) stroke.points_px.push_back(to.px(p));
        const float first = widths[branch.nodes[0]],
                    second = widths[branch.nodes[std::min<std::size_t>(1, branch.nodes.size() - 1)]];
        const bool joins = branch.parent_branch != Branch::kNone;
        const float at_joint = joins ? kHiddenInParent * std::min(first, second) : first;
        stroke.width_px.assign(lines[s].lead, at_joint * to.width_scale);
        stroke.width_px.push_back(at_joint * to.width_scale);
        for (std::size_t k = 1; k < branch.nodes.size(); ++k)
            stroke.width_px.push_back(widths[branch.nodes[k]] * to.width_scale);
    }
    return out;
}

/// Beside the strokes: the share of all tips that each point carries.
std::vector<std::vector<float>> tip_shares(const std::vector<Centreline>& lines, const Branching& b) {
    std::vector<std::vector<float>> out(lines.size());
    float most = 1;
    for (const std::uint32_t tips : b.tips) most = std::max(most, float(tips));
    for (std::size_t s = 0; s < lines.size(); ++s) {
        const Branch& branch = b.branches[lines[s].branch];
        out[s].assign(lines[s].lead, float(b.tips[branch.nodes[0]]) / most);
        for (const std::uint32_t v : branch.nodes) out[s].push_back(float(b.tips[v]) / most);
    }
    return out;
}

/// Share of every lattice cell that the strokes ink.
Grid<float> drawn_ink(std::vector<VariableStroke> strokes_lattice, Extent lattice, const Work& work) {
    DisplayList list{float(lattice.x), float(lattice.y), {{1, 1, 1, 1}, 0, 0}, {}};
    Layer layer{"ink", Blend::max, {}};
    for (VariableStroke& stroke : strokes_lattice) {
        stroke.colour = {0, 0, 0, 1};
        layer.items.push_back(std::move(stroke));
    }
    list.layers.push_back(std::move(layer));
    const Picture black_on_white = raster(list, {lattice}, work);
    Grid<float> out(lattice);
    std::transform(black_on_white.begin(), black_on_white.end(), out.begin(),
                   [](Rgba8 p) { return 1 - float(p.r) / 255; });
    return out;
}

/// Draws, compares the ink with the wanted tone, corrects, as often as the style says.
void fit_tone(Widths& widths, int passes, const std::vector<Centreline>& lines, const Dendrite& dendrite,
              const Branching& b, float u, const Work& work) {
    constexpr float kTargetWindow_u = 4, kDrawnWindow_u = 6;
    const Grid<float> target = blurred(widths.target_ink(), kTargetWindow_u * u);
    for (int pass = 0; pass < passes; ++pass) {
        work.check();
        const Grid<float> ink =
            drawn_ink(strokes(lines, dendrite, b, widths.widths(), {1, 1, 1}), target.extent(), work);
        widths.correct(target, blurred(ink, kDrawnWindow_u * u));
    }
}

Grid<float> weighted_sum(Fields& fields, const FieldWeights& weights) {
    Grid<float> out(fields.extent(), 0.0f);
    for (const auto& [name, weight] : weights) {
        const Grid<float>& field = fields[name];
        for (std::size_t n = 0; n < out.size(); ++n) out[n] += weight * field[n];
    }
    return out;
}

/// One growth, smooth and with its widths.
struct Candidate {
    PreparedPicture base;
    Grown grown;
    Branching branching;
    std::vector<Centreline> lines;
    std::vector<float> widths;
};

Candidate candidate(const Picture& picture, const Style& style, const Controls& controls, const Work& work) {
    Candidate c{prepared_picture(picture, style, controls, work), {}, {}, {}, {}};
    Fields& fields = c.base.fields;
    const float u = fields.u();
    c.grown = grow(c.base, style, controls, picture.extent(), {}, work);
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
    Widths widths(
        dendrite, c.branching, style.width,
        {fields["wanted"], fields["lines"], fields["importance"], style.width.field > 0 ? &width_sum : nullptr,
         &c.grown.node_cost, half_width.empty() ? nullptr : &half_width, &fields["guided"]},
        u);
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

/// The best of several growths from seeds that follow from the run's; the first of equals.
Candidate best_candidate(const Picture& picture, const Style& style, const Controls& controls, const Work& work) {
    const int growths = controls.endpoints.empty() ? style.choice.growths : 1;
    if (growths == 1) return candidate(picture, style, controls, work);
    std::vector<std::optional<Candidate>> all(static_cast<std::size_t>(growths));
    std::vector<double> score(all.size());
    tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t k) {
        Controls own = controls;
        own.seed = growth_seed(controls.seed, int(k));
        Work quiet = work;
        if (k > 0) quiet.progress = nullptr;
        all[k] = candidate(picture, style, own, quiet);
        score[k] = resemblance(*all[k], style.choice.window * all[k]->base.fields.u());
    });
    return std::move(*all[std::size_t(std::max_element(score.begin(), score.end()) - score.begin())]);
}

Drawing stylized(const Picture& picture, const Style& style, const Controls& controls, const Work& work) {
    work.report("fields", 0);
    Candidate best = best_candidate(picture, style, controls, work);
    Fields& fields = best.base.fields;
    const float u = fields.u();
    Drawing out;
    out.lattice = fields.extent();
    out.picture = picture.extent();
    out.dendrite = std::move(best.grown.dendrite);
    out.endpoints = std::move(best.grown.endpoints);
    out.unreached = best.grown.unreached;
    for (const StageParameters& stage : style.stages) out.stage_names.push_back(stage.name);

    work.report("drawing", 0.85);
    const Frame to = frame(out.lattice, out.picture);
    std::vector<VariableStroke> drawn = strokes(best.lines, out.dendrite, best.branching, best.widths, to);
    for (std::size_t s = 0; s < drawn.size(); ++s) {
        // A trunk may go on as a branch behind: where a stroke begins says where it belongs.
        const std::vector<std::uint32_t>& nodes = best.branching.branches[best.lines[s].branch].nodes;
        const std::uint8_t stage = out.dendrite.stage[nodes[std::min<std::size_t>(1, nodes.size() - 1)]];
        drawn[s].layer = std::uint8_t(style.stages[stage].layer);
    }
    const std::vector<std::vector<float>> shares = tip_shares(best.lines, best.branching);
    out.strokes = drawn.size();
    out.width_u = std::move(best.widths);
    for (float& w : out.width_u) w /= float(out.lattice.long_side()) / 1024;
    out.list = style.metaphor->draw({float(out.picture.x), float(out.picture.y), u * to.width_scale, to.width_scale,
                                     drawn, [&](std::string_view name) -> const Grid<float>& { return fields[name]; },
                                     controls.seed, &picture, shares});
    return out;
}

}  // namespace

Drawing stylize(const Picture& picture, const Style& style, const Controls& controls, const Work& work) {
    if (work.threads <= 0) return stylized(picture, style, controls, work);
    tbb::task_arena arena(work.threads);
    return arena.execute([&] { return stylized(picture, style, controls, work); });
}

}  // namespace dstylize
