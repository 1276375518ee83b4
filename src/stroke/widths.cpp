// Widths carry the tone: where lines are sparse they must be wide to make the same dark. First a raw
// width per node from the rules, then what makes a stroke of it: a rolling mean along the branch, a
// floor for the trunk, no branch wider than its parent at the junction, tips that run out.
#include "stroke/widths.h"

#include <algorithm>
#include <cmath>

#include "core/sampling.h"
#include "imaging/bands.h"
#include "imaging/filters.h"

namespace dstylize {
namespace {

/// Length of line per unit of area around every node.
Grid<float> line_density(const Dendrite& d, Extent extent, float sigma) {
    Grid<float> length(extent, 0.0f);
    for (std::uint32_t v = 0; v < d.size(); ++v) {
        if (d.is_root(v)) continue;
        const Vec2f p = d.position_lattice[v];
        length(std::clamp(int(p.x), 0, extent.x - 1), std::clamp(int(p.y), 0, extent.y - 1)) +=
            distance(p, d.position_lattice[d.parent[v]]);
    }
    return blurred(length, sigma);
}

}  // namespace

void WidthParameters::visit(ParameterVisitor& v) {
    v.number({"tone", "", "weight of tone width: wanted tone / line density"}, tone, 0, 1);
    v.number({"importance", "", "weight of importance width"}, importance, 0, 1);
    v.number({"branch", "", "weight of branch width: grows with the number of tips that a node carries"}, branch, 0, 1);
    v.number({"tips", "", "weight of tips width: the narrowest times a power of the tips that a node carries"}, tips, 0,
             1);
    v.number({"constant", "", "weight of a constant width"}, constant, 0, 1);
    v.number({"field", "", "weight of a width that follows `fields`"}, field, 0, 1);
    v.number({"path", "", "weight of path width V = exp(-alpha (c T)^2): falls with the way's cost from the root"},
             path, 0, 1);
    v.number({"piped", "", "weight of pipe width: every twig runs down to the root"}, piped, 0, 1);
    v.number({"narrowest", "u", "narrowest stroke"}, narrowest, 0.05f, 20);
    v.number({"widest", "u", "widest stroke, the trunk apart"}, widest, 0.1f, 60);
    v.number({"constant_width", "u", "the constant width"}, constant_width, 0.05f, 60);
    v.number({"tone_gamma", "", "above 1 keeps mid-tones light"}, tone_gamma, 0.3f, 4);
    v.number({"tone_most", "", "ink coverage of the darkest tone"}, tone_most, 0.1f, 1);
    v.number({"tone_lines", "", "ink added on thin lines: eyes, mouth"}, tone_lines, 0, 1);
    v.integer({"feedback", "", "passes that compare the drawn ink with the wanted tone"}, feedback, 0, 8);
    v.number({"importance_gamma", "", "above 1 keeps unimportant strokes thin"}, importance_gamma, 0.3f, 4);
    v.field_weights({"fields", "", "weights of fields in the field width"}, fields);
    v.number({"field_gamma", "", "above 1 keeps strokes thin where those fields are low"}, field_gamma, 0.3f, 4);
    v.number({"path_alpha", "", "alpha: how fast path width falls; c is 1 at the dearest tip"}, path_alpha, 0, 200);
    v.number(
        {"path_side", "", "T of side branches by their order: 1, path_side, path_side^2, ...; they are 1 / T as wide"},
        path_side, 1, 10);
    v.number({"branch_exponent", "", "share of tips to this power is the branch width (pipe model: 0.5)"},
             branch_exponent, 0.1f, 1);
    v.number({"tips_exponent", "", "number of tips to this power, times the narrowest, is the tips width"},
             tips_exponent, 0.05f, 1);
    v.number({"room_share", "", "most of the shape's half width that a stroke may take; 0: no limit"}, room_share, 0,
             2);
    v.number({"trunk", "u", "least width of the trunk at its root, 0: no trunk"}, trunk, 0, 80);
    v.number({"trunk_least_tone", "", "share of the trunk's width that stays where the picture is light"},
             trunk_least_tone, 0, 1);
    v.number({"window", "u", "half length of the rolling mean along a branch"}, window, 0, 100);
    v.number({"tip", "u", "length over which a tip runs out"}, tip, 0, 200);
    v.number({"tip_width", "u", "width at the very tip"}, tip_width, 0, 10);
    v.number({"swing", "", "how much wider twigs are where ink is wanted, and thinner where not"}, swing, 0, 1);
    v.number({"wanted_gain", "", "the field `lacking` counts the wanted ink so often, as strokes overlap"}, wanted_gain,
             0.1f, 4);
    v.section("pipe", "the pipe rule", [this](ParameterVisitor& inner) { pipe.visit(inner); });
}

Widths::Widths(const Dendrite& dendrite, const Branching& branching, const WidthParameters& parameters,
               const WidthFields& fields, float u)
    : dendrite_(dendrite), branching_(branching), parameters_(parameters), fields_(fields), u_(u) {
    const WidthParameters& p = parameters_;
    if (p.wants_ink()) {
        constexpr float kMostInk = 0.92f;
        target_ink_ = blurred(*fields.tone, u);
        each_index(target_ink_.size(), [&](std::size_t n) {
            target_ink_[n] = std::min(kMostInk, p.tone_most * std::pow(std::max(0.0f, target_ink_[n]), p.tone_gamma) +
                                                    p.tone_lines * (*fields.lines)[n]);
        });
    }

    constexpr float kDensityWindow_u = 7, kImportanceInk = 0.1f, kLeastDensity = 0.02f;
    raw_.resize(dendrite.size());
    if (p.path > 0) follow_paths();
    Grid<float> density, wanted;
    if (p.tone > 0) {
        density = line_density(dendrite, target_ink_.extent(), kDensityWindow_u * u);
        wanted = blurred(target_ink_, kDensityWindow_u / 2 * u);
    }
    if (p.piped > 0) pipe_ = pipe_widths(dendrite, branching, p.pipe, u);
    each_index(raw_.size(), [&](std::size_t v) {
        float tone_width = 0;
        if (p.tone > 0) {
            const Vec2f at = dendrite.position_lattice[v];
            tone_width = (sample(wanted, at) + kImportanceInk * sample(fields.importance, at)) /
                         std::max(sample(density, at), kLeastDensity);
        }
        raw_[v] = raw_width(std::uint32_t(v), tone_width);
    });
    trunk_ = trunk_widths();
    finish();
}

/// V / T, V = exp(-alpha (c T)^2), c the cost of the way from the root as a share of the dearest. There a
/// stroke ends where V of the cost *across* it falls below a threshold, so that its width goes with 1 / T.
void Widths::follow_paths() {
    std::vector<float> cost(dendrite_.size(), 0.0f);
    float dearest = 0;
    for (std::uint32_t v = 0; v < cost.size(); ++v) {
        if (dendrite_.is_root(v)) continue;
        const std::uint32_t p = dendrite_.parent[v];
        cost[v] = cost[p] + distance(dendrite_.position_lattice[v], dendrite_.position_lattice[p]) *
                                (*fields_.node_cost)[index(dendrite_.node[v])];
        dearest = std::max(dearest, cost[v]);
    }
    path_share_.assign(cost.size(), 1.0f);
    if (dearest <= 0) return;
    for (const Branch& branch : branching_.branches) {
        const float side = std::pow(parameters_.path_side, float(branch.order));
        for (std::size_t k = branch.parent_branch == Branch::kNone ? 0 : 1; k < branch.nodes.size(); ++k) {
            const float c = cost[branch.nodes[k]] / dearest * side;
            path_share_[branch.nodes[k]] = std::exp(-parameters_.path_alpha * c * c) / side;
        }
    }
}

float Widths::raw_width(std::uint32_t v, float tone_width) const {
    const WidthParameters& p = parameters_;
    const float narrow = p.narrowest * u_, wide = p.widest * u_;
    const bool by_field = p.field > 0 && fields_.sum, by_path = !path_share_.empty();
    const float total = p.tone + p.importance + p.branch + p.tips + p.constant + (by_field ? p.field : 0) +
                        (by_path ? p.path : 0) + p.piped;
    if (total <= 0) return narrow;
    const auto between = [&](float share) { return narrow + (wide - narrow) * share; };
    float sum = p.tone * tone_width + p.constant * p.constant_width * u_;
    if (p.importance > 0)
        sum += p.importance *
               between(std::pow(sample(fields_.importance, dendrite_.position_lattice[v]), p.importance_gamma));
    if (p.branch > 0)
        sum += p.branch * between(std::pow(float(branching_.tips[v]) / float(branching_.tips[0]), p.branch_exponent));
    if (p.tips > 0) sum += p.tips * std::min(wide, narrow * std::pow(float(branching_.tips[v]), p.tips_exponent));
    if (by_field)
        sum += p.field * between(std::pow(std::clamp(sample(*fields_.sum, dendrite_.position_lattice[v]), 0.0f, 1.0f),
                                          p.field_gamma));
    if (by_path) sum += p.path * between(path_share_[v]);
    if (p.piped > 0) sum += p.piped * pipe_[v];
    float width = sum / total;
    if (p.swing > 0) width *= swing(v, width);
    float widest = wide * 1.3f;
    if (fields_.half_width && p.room_share > 0)
        widest = std::clamp(p.room_share * sample(*fields_.half_width, dendrite_.position_lattice[v]), narrow, widest);
    return std::clamp(width, narrow, widest);
}

/// Only twigs obey the picture; trunk and boughs stay a tree's.
float Widths::swing(std::uint32_t v, float width) const {
    constexpr float kTwig_u = 5.3f, kShare = 0.9f, kLeast = 0.5f;
    const Vec2f at = dendrite_.position_lattice[v];
    const float leads = fields_.guided ? sample(*fields_.guided, at) : 1;
    const float balance = leads * (2 * sample(target_ink_, at) - 1);
    return std::max(kLeast, 1 + kShare * parameters_.swing * balance * std::exp(-width / (kTwig_u * u_)));
}

void Widths::correct(const Grid<float>& target, const Grid<float>& drawn) {
    constexpr float kFloor = 0.03f;  // keeps the ratio calm where nothing is wanted and nothing drawn
    each_index(raw_.size(), [&](std::size_t v) {
        const Vec2f at = dendrite_.position_lattice[v];
        const float ratio = (sample(target, at) + kFloor) / (sample(drawn, at) + kFloor);
        raw_[v] = std::clamp(raw_[v] * std::clamp(ratio, 1 / kMostCorrection, kMostCorrection),
                             0.8f * parameters_.narrowest * u_, 1.4f * parameters_.widest * u_);
    });
    finish();
}

void Widths::finish() {
    widths_ = raw_;
    roll(widths_);
    raise_trunk();
    cap_at_junctions();
    taper_tips();
}

/// Calls f for all branches, several at a time.
template <class F>
void Widths::each_branch(F f) const {
    const auto of_index = [&](std::size_t b) { f(branching_.branches[b]); };
    each_index(branching_.branches.size(), of_index, kBandOfBranches);
}

/// Mean over +-window along the branch, reaching into the parent at the start and past the tip at the
/// end, where nothing is: so branches thin out by themselves (004 s. 4.3).
void Widths::roll(std::vector<float>& values) const {
    const auto reach = std::size_t(parameters_.window * u_);
    if (reach == 0) return;
    std::vector<float> out = values;
    each_branch([&](const Branch& branch) {
        const std::size_t first = branch.parent_branch == Branch::kNone ? 0 : 1;
        std::vector<float> before;
        for (std::uint32_t v = branch.nodes[0]; before.size() < reach; v = dendrite_.parent[v]) {
            before.push_back(values[v]);
            if (dendrite_.is_root(v)) break;
        }
        before.resize(reach, before.back());
        std::vector<double> sums{0};
        sums.reserve(2 * reach + branch.nodes.size() + 1);
        for (auto k = before.rbegin(); k != before.rend(); ++k) sums.push_back(sums.back() + *k);
        for (std::size_t k = first; k < branch.nodes.size(); ++k) sums.push_back(sums.back() + values[branch.nodes[k]]);
        sums.insert(sums.end(), reach, sums.back());
        for (std::size_t k = first; k < branch.nodes.size(); ++k) {
            const std::size_t centre = reach + k - first;
            out[branch.nodes[k]] = float((sums[centre + reach + 1] - sums[centre - reach]) / double(2 * reach + 1));
        }
    });
    values = std::move(out);
}

/// Few thick limbs, many hairs. The picture's tone tempers the trunk: an even one through a bright
/// cheek ruins the face.
std::vector<float> Widths::trunk_widths() const {
    constexpr float kToneWindow_u = 5;
    const WidthParameters& p = parameters_;
    if (p.trunk <= 0) return {};
    const Grid<float> tone = blurred(*fields_.tone, kToneWindow_u * u_);
    std::vector<float> out(dendrite_.size());
    each_index(out.size(), [&](std::size_t v) {
        const float share = std::pow(float(branching_.tips[v]) / float(branching_.tips[0]), p.branch_exponent);
        const float tempered =
            p.trunk_least_tone + (1 - p.trunk_least_tone) * sample(tone, dendrite_.position_lattice[v]);
        out[v] = p.trunk * u_ * share * tempered;
    });
    return out;
}

void Widths::raise_trunk() {
    for (std::size_t v = 0; v < trunk_.size(); ++v) widths_[v] = std::max(widths_[v], trunk_[v]);
    const float widest = std::max(parameters_.widest, parameters_.trunk) * u_;
    for (float& width : widths_) width = std::min(width, widest);
}

void Widths::cap_at_junctions() {
    constexpr float kShareOfParent = 0.95f;
    const float release = 13 * u_;
    const float widest = std::max(parameters_.widest, parameters_.trunk) * u_;
    for (const Branch& branch : branching_.branches) {
        if (branch.parent_branch == Branch::kNone) continue;
        const float cap = kShareOfParent * widths_[branch.nodes[0]];
        float arc = 0;
        for (std::size_t k = 1; k < branch.nodes.size() && arc < release; ++k) {
            arc +=
                distance(dendrite_.position_lattice[branch.nodes[k]], dendrite_.position_lattice[branch.nodes[k - 1]]);
            float& width = widths_[branch.nodes[k]];
            width = std::min(width, cap + (widest - cap) * smoothstep(0, release, arc));
        }
    }
}

/// A thick tip needs a longer run-out than a thin one, or it ends blunt.
void Widths::taper_tips() {
    constexpr float kLengthsPerWidth = 5;
    const WidthParameters& p = parameters_;
    each_branch([&](const Branch& branch) {
        float total = 0;
        for (std::size_t k = 1; k < branch.nodes.size(); ++k)
            total +=
                distance(dendrite_.position_lattice[branch.nodes[k]], dendrite_.position_lattice[branch.nodes[k - 1]]);
        const float at_tip = p.tip_width * u_;
        float arc = 0, thickest = 0;
        for (std::size_t k = branch.nodes.size(); k-- > 1;) {
            float& width = widths_[branch.nodes[k]];
            thickest = std::max(thickest, width);
            const float length = std::min(total, std::max(p.tip * u_, kLengthsPerWidth * thickest));
            const float t = length > 0 ? std::min(1.0f, arc / length) : 1;
            width = std::min(width, at_tip + std::max(0.0f, width - at_tip) * std::sqrt(t) * (1.5f - 0.5f * t));
            arc +=
                distance(dendrite_.position_lattice[branch.nodes[k]], dendrite_.position_lattice[branch.nodes[k - 1]]);
            if (arc > std::max(p.tip * u_, kLengthsPerWidth * std::max(p.widest, p.trunk) * u_)) break;
        }
    });
}

}  // namespace dstylize
