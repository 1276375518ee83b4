#include "pipeline/roots.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.h"
#include "imaging/filters.h"

namespace dstylize {
namespace {

using Place = RootParameters::Place;

NodeId cheapest_near(const WeightedLattice& graph, const PassableParts& parts, NodeId start, float radius) {
    const Lattice& lattice = graph.lattice;
    const int column = lattice.column(start), row = lattice.row(start), reach = int(radius);
    const std::uint32_t part = parts.part[index(start)];
    NodeId best = start;
    int best_distance = 0;
    for (int j = std::max(0, row - reach); j <= std::min(lattice.extent().y - 1, row + reach); ++j)
        for (int i = std::max(0, column - reach); i <= std::min(lattice.extent().x - 1, column + reach); ++i) {
            const NodeId node = lattice.at(i, j);
            const int away = (i - column) * (i - column) + (j - row) * (j - row);
            if (away > reach * reach || parts.part[index(node)] != part) continue;
            const auto weight = graph.weight[index(node)], least = graph.weight[index(best)];
            if (weight < least || (weight == least && away < best_distance)) {
                best = node;
                best_distance = away;
            }
        }
    return best;
}

/// How good a node is for a root of that kind, or -inf where it cannot be.
class PlaceScore {
  public:
    PlaceScore(Fields& fields, const RootParameters& parameters, Place place)
        : place_(place),
          u_(fields.u()),
          inset_(parameters.inset * u_),
          centring_(parameters.centring),
          interest_(blurred(fields[place == Place::darkest ? "darkness" : std::string_view(parameters.interest)],
                            (place == Place::darkest ? 6 : 3) * u_)) {}

    /// Whether any node of that row can be one.
    bool row_counts(const PassableParts::Box& box, int j) const {
        constexpr float kBand_u = 3;
        if (place_ != Place::bottom && place_ != Place::top) return true;
        const float from_edge = place_ == Place::bottom ? float(box.bottom - j) : float(j - box.top);
        const float wanted = std::min(inset_, (float(box.bottom - box.top) + 1) / 4);
        return std::abs(from_edge - wanted) <= std::max(kBand_u * u_, 1.0f);
    }

    float operator()(const PassableParts::Box& box, int i, int j) const {
        if (!row_counts(box, j)) return kNever;
        const float width = float(box.right - box.left) + 1, height = float(box.bottom - box.top) + 1;
        const float x = 2 * (float(i - box.left) + 0.5f) / width - 1;  // -1 … 1 across the part
        const float y = 2 * (float(j - box.top) + 0.5f) / height - 1;
        const float interest = interest_(i, j);
        if (place_ == Place::darkest) return interest;
        if (place_ == Place::centre)
            return std::max(std::abs(x), std::abs(y)) <= 0.5f || width * height < 9 ? interest - 0.1f * (x * x + y * y)
                                                                                    : kNever;
        return interest - centring_ * x * x;
    }
    static constexpr float kNever = -1e9f;

  private:
    Place place_;
    float u_, inset_, centring_;
    Grid<float> interest_;
};

/// The best node of every part that is worth a root.
std::vector<NodeId> best_of_parts(Fields& fields, const WeightedLattice& graph, const PassableParts& parts,
                                  const RootParameters& parameters, Place place) {
    const Extent e = graph.lattice.extent();
    const PlaceScore score(fields, parameters, place);
    std::vector<std::uint8_t> row_counts(std::size_t(e.y), 0);
    for (const PassableParts::Box& box : parts.box)
        for (int j = box.top; j <= box.bottom; ++j) row_counts[std::size_t(j)] |= score.row_counts(box, j);
    std::vector<NodeId> best(parts.size.size(), kNoNode);
    std::vector<float> best_score(parts.size.size(), 2 * PlaceScore::kNever);
    for (int j = 0; j < e.y; ++j) {
        if (!row_counts[std::size_t(j)]) continue;
        for (int i = 0; i < e.x; ++i) {
            const std::uint32_t part = parts.part(i, j);
            if (part == PassableParts::kNone) continue;
            const float s = score(parts.box[part], i, j);
            if (s > best_score[part]) {
                best_score[part] = s;
                best[part] = graph.lattice.at(i, j);
            }
        }
    }
    return best;
}

NodeId chosen_node(const WeightedLattice& graph, const RootChoice& choice, Extent picture) {
    const double x = choice.x.px(picture.x), y = choice.y.px(picture.y);
    const std::string what = fmt::format("--root {},{}", choice.x.value, choice.y.value);
    if (!(x >= 0 && y >= 0 && x <= picture.x && y <= picture.y))
        throw Error(ErrorCode::bad_usage, "", what + " lies outside the picture",
                    fmt::format("it is {} x {} pixels; fractions go from 0.0 to 1.0", picture.x, picture.y));
    const Extent e = graph.lattice.extent();
    return graph.lattice.nearest({float(x / picture.x * e.x), float(y / picture.y * e.y)});
}

/// The passable node nearest to `start` within `radius`, or kNoNode.
NodeId passable_near(const WeightedLattice& graph, NodeId start, float radius) {
    const Lattice& lattice = graph.lattice;
    const int column = lattice.column(start), row = lattice.row(start), reach = int(std::ceil(radius));
    NodeId best = kNoNode;
    int best_distance = reach * reach + 1;
    for (int j = std::max(0, row - reach); j <= std::min(lattice.extent().y - 1, row + reach); ++j)
        for (int i = std::max(0, column - reach); i <= std::min(lattice.extent().x - 1, column + reach); ++i) {
            const int away = (i - column) * (i - column) + (j - row) * (j - row);
            if (away < best_distance && graph.passable(lattice.at(i, j))) {
                best = lattice.at(i, j);
                best_distance = away;
            }
        }
    return best;
}

}  // namespace

std::vector<NodeId> root_nodes(Fields& fields, const WeightedLattice& graph, const RootParameters& parameters,
                               const std::vector<RootChoice>& chosen, Extent picture_px) {
    constexpr float kMoveAtMost_u = 8;
    const PassableParts parts = passable_parts(graph);
    if (parts.size.empty())
        throw Error(ErrorCode::failed, "", "nothing can grow: the mask or the transparent picture leaves no room",
                    "give a mask with some white, or a picture that is not all transparent");
    std::vector<RootChoice> choices = chosen;
    if (choices.empty()) choices.push_back({parameters.place, {}, {}});
    const float smallest = std::min(parameters.smallest_part * fields.u() * fields.u(),
                                    float(*std::max_element(parts.size.begin(), parts.size.end())));
    // A user thinks in the picture's frame, whatever u the style has.
    const float margin = kMoveAtMost_u * float(graph.lattice.extent().long_side()) / 1024;
    std::vector<NodeId> out;
    for (const RootChoice& choice : choices) {
        std::vector<NodeId> starts;
        if (choice.place) {
            starts = best_of_parts(fields, graph, parts, parameters, *choice.place);
        } else {
            // The margin at the frame is ours, not the user's: a root there moves just inside.
            const NodeId at = passable_near(graph, chosen_node(graph, choice, picture_px), margin);
            if (at == kNoNode)
                throw Error(ErrorCode::bad_usage, "",
                            fmt::format("--root {},{} lies where nothing may grow", choice.x.value, choice.y.value),
                            "move it into the white part of the mask");
            starts.push_back(at);
        }
        for (const NodeId start : starts) {
            if (choice.place && float(parts.size[parts.part[index(start)]]) < smallest) continue;
            const NodeId node = cheapest_near(graph, parts, start, kMoveAtMost_u * fields.u());
            if (std::find(out.begin(), out.end(), node) == out.end()) out.push_back(node);
        }
    }
    if (!parameters.every_part || chosen.empty()) return out;
    std::vector<bool> has_root(parts.size.size(), false);
    for (const NodeId node : out) has_root[parts.part[index(node)]] = true;
    for (const NodeId start : best_of_parts(fields, graph, parts, parameters, parameters.place)) {
        const std::uint32_t part = parts.part[index(start)];
        if (!has_root[part] && float(parts.size[part]) >= smallest)
            out.push_back(cheapest_near(graph, parts, start, kMoveAtMost_u * fields.u()));
    }
    return out;
}

}  // namespace dstylize
