// Every intermediate as a picture: seeing is how people learn the parameters.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "core/error.h"
#include "core/noise.h"
#include "pipeline/candidate.h"
#include "pipeline/growth.h"
#include "pipeline/prepared_picture.h"
#include "pipeline/style_file.h"
#include "pipeline/stylize.h"

namespace dstylize {
namespace {

constexpr std::array<std::string_view, 5> kStageViews{"weights", "endpoints", "distance", "owners", "tree"};
constexpr Rgba8 kWhite{255, 255, 255, 255}, kBlack{0, 0, 0, 255}, kForbidden{120, 30, 30, 255};

Rgba8 grey(float v) {
    const auto g = std::uint8_t(std::lround(255 * std::clamp(v, 0.0f, 1.0f)));
    return {g, g, g, 255};
}
/// Full colours around the wheel, `turn` in [0, 1).
Rgba8 hue(float turn, float lightness) {
    const auto channel = [&](float offset) {
        const float h = std::abs(std::fmod(turn + offset, 1.0f) * 6 - 3) - 1;
        return std::uint8_t(std::lround(255 * lightness * std::clamp(h, 0.0f, 1.0f)));
    };
    return {channel(0), channel(2.0f / 3), channel(1.0f / 3), 255};
}

Picture field_picture(const Grid<float>& field) {
    Picture out(field.extent());
    std::transform(field.begin(), field.end(), out.begin(), grey);
    return out;
}

Picture flow_picture(const FlowField& flow) {
    Picture out(flow.extent());
    for (std::size_t n = 0; n < flow.size(); ++n) {
        const float turn =
            std::atan2(flow[n].y, flow[n].x) / 3.14159265f + 1;  // a direction, not a vector: half a turn
        out[n] = hue(std::fmod(turn, 1.0f), 0.25f + 0.75f * length(flow[n]));
    }
    return out;
}

Picture weights_picture(const WeightedLattice& graph) {
    Picture out(graph.lattice.extent(), kForbidden);
    const float dearest = std::max<float>(2, *std::max_element(graph.weight.begin(), graph.weight.end()));
    for (std::size_t n = 0; n < graph.weight.size(); ++n)
        if (graph.weight[n]) out[n] = grey(1 - float(graph.weight[n] - 1) / (dearest - 1));
    return out;
}

void dot(Picture& out, int column, int row, int radius, Rgba8 colour) {
    for (int j = row - radius; j <= row + radius; ++j)
        for (int i = column - radius; i <= column + radius; ++i)
            if (out.extent().contains(i, j) && (i - column) * (i - column) + (j - row) * (j - row) <= radius * radius)
                out(i, j) = colour;
}

Picture endpoints_picture(const Lattice& lattice, const std::vector<NodeId>& endpoints) {
    Picture out(lattice.extent(), kWhite);
    const int radius = std::max(1, lattice.extent().long_side() / 800);
    for (const NodeId node : endpoints) dot(out, lattice.column(node), lattice.row(node), radius, kBlack);
    return out;
}

/// The contours of 004 fig. 5: nodes in the order in which a search from the root reaches them, early
/// ones light, with a line at every twentieth part of them.
Picture distance_picture(const Lattice& lattice, const Plan& plan) {
    constexpr int kContours = 20;
    std::vector<std::uint32_t> order;
    for (std::uint32_t n = 0; n < plan.label.size(); ++n)
        if (plan.label[n].sum != PathLabel::kUnreached) order.push_back(n);
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
        const PathLabel &p = plan.label[a], &q = plan.label[b];
        return p.highest != q.highest ? p.highest < q.highest : p.sum != q.sum ? p.sum < q.sum : a < b;
    };
    std::sort(order.begin(), order.end(), before);
    Grid<int> band(lattice.extent(), -1);
    Picture out(lattice.extent(), kForbidden);
    for (std::size_t k = 0; k < order.size(); ++k) {
        const float share = float(k) / float(order.size());
        band[order[k]] = int(share * kContours);
        out[order[k]] = grey(1 - 0.8f * share);
    }
    for (int j = 0; j + 1 < lattice.extent().y; ++j)
        for (int i = 0; i + 1 < lattice.extent().x; ++i)
            if (band(i, j) >= 0 && (band(i, j) != band(i + 1, j) || band(i, j) != band(i, j + 1))) out(i, j) = kBlack;
    return out;
}

Picture owners_picture(const Lattice& lattice, const Plan& plan) {
    Picture out(lattice.extent(), kForbidden);
    for (std::size_t n = 0; n < plan.owner.size(); ++n)
        if (plan.owner[n] != Plan::kNoOwner)
            out[n] = hue(std::fmod(0.11f + 0.618034f * float(plan.owner[n]), 1.0f), 0.9f);  // golden-ratio hues
    return out;
}

Picture tree_picture(const Lattice& lattice, const Dendrite& dendrite) {
    Picture out(lattice.extent(), kWhite);
    for (std::uint32_t v = 0; v < dendrite.size(); ++v) {
        const Vec2f to = dendrite.position_lattice[v];
        const Vec2f from = dendrite.is_root(v) ? to : dendrite.position_lattice[dendrite.parent[v]];
        const int steps = std::max(1, int(distance(from, to)));
        for (int k = 0; k <= steps; ++k) {
            const Vec2f p = lerp(from, to, float(k) / float(steps));
            dot(out, int(p.x), int(p.y), 0, dendrite.stage[v] == 0 ? kBlack : Rgba8{70, 70, 110, 255});
        }
    }
    return out;
}

Picture stage_picture(std::string_view view, const StageView& stage) {
    if (view == "weights") return weights_picture(stage.graph);
    if (view == "endpoints") return endpoints_picture(stage.graph.lattice, stage.endpoints);
    if (view == "distance") return distance_picture(stage.graph.lattice, stage.plan);
    return owners_picture(stage.graph.lattice, stage.plan);
}

}  // namespace

std::vector<std::string> shown_names(const Style& style) {
    std::vector<std::string> out(Fields::names().begin(), Fields::names().end());
    out.emplace_back("flow");
    for (const std::string_view view : kStageViews) {
        out.emplace_back(view);
        for (const StageParameters& stage : style.stages) out.push_back(fmt::format("{}:{}", view, stage.name));
    }
    return out;
}

namespace {

/// What a name asks for: `view` or `view:stage`, without a stage the last one's.
struct Wanted {
    std::string view, stage;
    bool is_of_growth() const { return std::find(kStageViews.begin(), kStageViews.end(), view) != kStageViews.end(); }
};

std::vector<Wanted> all_wanted(const std::vector<std::string>& names, const Style& style) {
    const std::vector<std::string> known = shown_names(style);
    std::vector<Wanted> out;
    for (const std::string& name : names) {
        if (std::find(known.begin(), known.end(), name) == known.end())
            throw Error(ErrorCode::bad_usage, "", "--show " + name + ": no such stage",
                        fmt::format("use one of {}", fmt::join(known, ", ")));
        const std::size_t colon = name.find(':');
        out.push_back(
            {name.substr(0, colon), colon == std::string::npos ? style.stages.back().name : name.substr(colon + 1)});
    }
    return out;
}

}  // namespace

std::vector<Picture> shown(const std::vector<std::string>& names, const Picture& picture, const Style& style,
                           const Controls& controls, const Work& work) {
    const std::vector<Wanted> wanted = all_wanted(names, style);
    std::vector<Picture> out(names.size());
    PreparedPicture base = prepared_picture(picture, style, controls, work);
    for (std::size_t k = 0; k < wanted.size(); ++k) {
        if (wanted[k].view == "flow")
            out[k] = flow_picture(base.fields.flow());
        else if (!wanted[k].is_of_growth())
            out[k] = field_picture(base.fields[wanted[k].view]);
    }
    if (std::none_of(wanted.begin(), wanted.end(), [](const Wanted& w) { return w.is_of_growth(); })) return out;

    Controls chosen = controls;
    chosen.seed = best_seed(picture, style, controls, work);
    if (chosen.seed != controls.seed) base = prepared_picture(picture, style, chosen, work, &base);
    const auto observe = [&](const StageView& stage) {
        for (std::size_t k = 0; k < wanted.size(); ++k)
            if (wanted[k].is_of_growth() && wanted[k].view != "tree" && wanted[k].stage == stage.stage.name)
                out[k] = stage_picture(wanted[k].view, stage);
    };
    const Grown grown = grow(base, style, chosen, picture.extent(), observe, work);
    for (Picture& p : out)
        if (p.empty()) p = tree_picture(base.lattice, grown.dendrite);
    return out;
}

}  // namespace dstylize
