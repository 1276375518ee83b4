#include "pipeline/stylize.h"

#include <tbb/task_arena.h>

#include <algorithm>

#include "pipeline/candidate.h"

namespace dstylize {
namespace {

/// Lattice frame to picture frame.
StrokeFrame frame(Extent lattice, Extent picture) {
    const float x = float(picture.x) / float(lattice.x), y = float(picture.y) / float(lattice.y);
    // A side of one node says nothing about the scale.
    return {x, y, lattice.x >= lattice.y ? x : y};
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

/// Upper left corner of the picture where it is set into the frame.
Vec2f picture_corner(Extent frame, const LatticeParameters& p) {
    return {(p.picture_x - 0.5f * p.picture_scale) * float(frame.x),
            (p.picture_y - 0.5f * p.picture_scale) * float(frame.y)};
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
    const StrokeFrame to = frame(out.lattice, out.picture);
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
                                     controls.seed, &picture, shares, picture_corner(out.picture, style.lattice),
                                     style.lattice.picture_scale, controls.no_picture});
    return out;
}

}  // namespace

Drawing stylize(const Picture& picture, const Style& style, const Controls& controls, const Work& work) {
    if (work.threads <= 0) return stylized(picture, style, controls, work);
    tbb::task_arena arena(work.threads);
    return arena.execute([&] { return stylized(picture, style, controls, work); });
}

}  // namespace dstylize
