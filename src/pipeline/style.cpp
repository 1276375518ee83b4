#include "pipeline/style.h"

#include <array>

namespace dstylize {

void LatticeParameters::visit(ParameterVisitor& v) {
    static constexpr std::array<std::string_view, 3> kNeighbourhoods{"4", "8", "16"};
    v.integer({"detail", "nodes", "lattice nodes on the picture's long side"}, detail, 16, 16384);
    choice(v, {"neighbours", "", "steps a path can take from a node; 16 takes staircases out of long lines"},
           neighbourhood, kNeighbourhoods);
    v.number({"margin", "u", "nothing grows this near to the frame"}, margin, 0, 100);
    v.number({"stem", "u", "with a mask, u is such that its strokes are this wide; 0: 1/1024 of the long side"}, stem,
             0, 512);
}

void RootParameters::visit(ParameterVisitor& v) {
    static constexpr std::array<std::string_view, 4> kPlaces{"bottom", "top", "centre", "darkest"};
    choice(v, {"place", "", "where growth starts, always on a cheap node nearby"}, place, kPlaces);
    v.number({"inset", "u", "how far from the frame the bottom or top root lies"}, inset, 0, 200);
    v.text({"interest", "", "field whose high places are good for roots"}, interest);
    v.number({"smallest_part", "u^2", "connected parts of the mask smaller than this get no root"}, smallest_part, 0,
             1e6f);
    v.flag({"every_part", "", "parts in which the user puts no root get one of their own"}, every_part);
}

void EndpointParameters::visit(ParameterVisitor& v) {
    static constexpr std::array<std::string_view, 2> kRules{"stipples", "discs"};
    choice(v, {"rule", "", "stipples by graph distance (Mould 2007), or variable Poisson discs"}, rule, kRules);
    v.text({"density", "", "field that sets the spacing: 0 calm, 1 dense"}, density);
    v.number({"density_blur", "u", "blur of that field"}, density_blur, 0, 100);
    v.number({"density_exponent", "", "below 1 gives mid-tones more, thinner lines"}, density_exponent, 0.1f, 4);
    v.number({"density_toe", "", "thins out endpoints where the field is below this"}, density_toe, 0, 1);
    v.text({"priority", "", "discs: field whose highest places come first"}, priority);
    v.number({"at_least", "", "discs: none where the priority field is lower"}, at_least, 0, 1);
    v.number({"jitter", "", "discs: random share in the priority"}, jitter, 0, 4);
    v.number({"calm_spacing", "u", "distance between endpoints at density 0"}, calm_spacing, 0.5f, 500);
    v.number({"dense_spacing", "u", "distance between endpoints at density 1"}, dense_spacing, 0.5f, 500);
    v.number({"close_loops", "u", "discs: join ways around holes that are longer than this; 0: leave them open"},
             close_loops, 0, 2000);
    v.number({"keep_off", "", "discs: share of the spacing kept from what is drawn already"}, keep_off, 0, 2);
}

void StageParameters::visit(ParameterVisitor& v) {
    static constexpr std::array<std::string_view, 2> kSources{"root", "dendrite"};
    v.text({"name", "", "by which --set and --show address this stage"}, name);
    choice(v, {"metric", "", "how paths are compared"}, metric, metric_names());
    v.integer({"blend_factor", "", "weight of the highest edge in the metric `blend`"}, blend_factor, 0, 1000000);
    choice(v, {"sources", "", "paths start at the root, or anywhere on the dendrite so far"}, sources, kSources);
    v.number({"carry", "", "share of the way from the root that paths remember: 0 hedgehogs, 0.8 plants"}, carry, 0, 1);
    v.field_weights({"cost", "", "weights of fields in a node's cost"}, cost);
    v.number({"cost_constant", "", "constant part of a node's cost"}, cost_constant, -4, 20);
    v.number({"cost_power", "", "above 1 makes paths shun costly nodes"}, cost_power, 0.25f, 8);
    v.number({"cost_max", "", "this much cost is the dearest node"}, cost_max, 0.01f, 100);
    v.integer({"levels", "", "integer steps between the cheapest and the dearest node"}, levels, 2, 65535);
    v.number({"along_flow", "", "how much dearer it is to cross the picture's structures than to follow them"},
             along_flow, 0, 20);
    v.number({"down", "", "how much dearer it is to grow upwards than downwards"}, down, 0, 20);
    v.section("endpoints", "where paths must arrive", [this](ParameterVisitor& inner) { endpoints.visit(inner); });
}

void Style::visit(ParameterVisitor& v) {
    v.section("lattice", "what the dendrite grows on", [this](ParameterVisitor& inner) { lattice.visit(inner); });
    v.section("fields", "what is read off the picture", [this](ParameterVisitor& inner) { fields.visit(inner); });
    v.section("root", "where growth starts", [this](ParameterVisitor& inner) { root.visit(inner); });
    for (StageParameters& stage : stages)
        v.section("stage." + stage.name, "one round of growth",
                  [&stage](ParameterVisitor& inner) { stage.visit(inner); });
    v.section("stroke", "branches to smooth centrelines", [this](ParameterVisitor& inner) { stroke.visit(inner); });
    v.section("width", "how wide strokes are", [this](ParameterVisitor& inner) { width.visit(inner); });
    v.section(metaphor_name, "how strokes are dressed", [this](ParameterVisitor& inner) { metaphor->visit(inner); });
}

}  // namespace dstylize
