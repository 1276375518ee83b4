#include "pipeline/style.h"

#include <array>

namespace dstylize {

void LatticeParameters::visit(ParameterVisitor& v) {
    static constexpr std::array<std::string_view, 3> kNeighbourhoods{"4", "8", "16"};
    static constexpr std::array<std::string_view, 3> kKinds{"regular", "hexagon", "scattered"};
    choice(v,
           {"kind", "",
            "squares, hexagons (6 neighbours), or scattered nodes joined to their 12 nearest: no straight runs"},
           kind, kKinds);
    v.integer({"detail", "nodes", "lattice nodes on the picture's long side"}, detail, 16, 16384);
    choice(v, {"neighbours", "", "regular: steps a path can take from a node; 16 takes staircases out of long lines"},
           neighbourhood, kNeighbourhoods);
    v.number(
        {"jitter", "", "regular, hexagon: nodes are moved by up to this share of half a step: roughens long lines"},
        jitter, 0, 1);
    v.number({"margin", "u", "nothing grows this near to the frame"}, margin, 0, 100);
    v.number({"stem", "u", "with a mask, u is such that its strokes are this wide; 0: 1/1024 of the long side"}, stem,
             0, 512);
    v.number({"picture_scale", "", "the picture's size inside the frame, as a share of it"}, picture_scale, 0.1f, 4);
    v.number({"picture_x", "", "where its middle lies, as a share of the frame's width"}, picture_x, -4, 5);
    v.number({"picture_y", "", "the same of the height"}, picture_y, -4, 5);
}

void RootParameters::visit(ParameterVisitor& v) {
    static constexpr std::array<std::string_view, 4> kPlaces{"bottom", "top", "centre", "darkest"};
    choice(v, {"place", "", "where growth starts, always on a cheap node nearby"}, place, kPlaces);
    v.number({"centring", "", "how much a place in the middle counts against an important one"}, centring, 0, 100);
    v.number({"inset", "u", "how far from the frame the bottom or top root lies"}, inset, 0, 200);
    v.text({"interest", "", "field whose high places are good for roots"}, interest);
    v.number({"smallest_part", "u^2", "connected parts of the mask smaller than this get no root"}, smallest_part, 0,
             1e6f);
    v.flag({"every_part", "", "parts in which the user puts no root get one of their own"}, every_part);
}

void EndpointParameters::visit(ParameterVisitor& v) {
    static constexpr std::array<std::string_view, 3> kRules{"stipples", "discs", "above"};
    choice(v, {"rule", "", "stipples by graph distance (Mould 2007), variable Poisson discs, or one above every root"},
           rule, kRules);
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
    v.number({"first_spacing", "", "discs: spacings of the first batch, as a multiple of the last batch's"},
             first_spacing, 1, 20);
    v.integer({"most", "", "discs: at most so many a batch, 0 for any number"}, most, 0, 1000000);
    v.number({"within", "edges", "only so near to the structure, counted in edges of 1024 nodes; 0: anywhere"}, within,
             0, 1000);
    v.number({"reach", "u", "above: how far above the root"}, reach, 1, 2000);
}

void StageParameters::visit(ParameterVisitor& v) {
    static constexpr std::array<std::string_view, 2> kSources{"root", "dendrite"};
    v.text({"name", "", "by which --set and --show address this stage"}, name);
    choice(v, {"metric", "", "how paths are compared"}, metric, metric_names());
    v.integer({"blend_factor", "", "weight of the highest edge in the metric `blend`"}, blend_factor, 0, 1000000);
    choice(v, {"sources", "", "paths start at the root, or anywhere on the dendrite so far"}, sources, kSources);
    v.number({"carry", "", "share of the way from the root that paths remember: 0 hedgehogs, 0.8 plants"}, carry, 0, 1);
    v.number({"carry_cost", "", "node cost at which that way is counted; 0: the mean one on the dendrite"}, carry_cost,
             0, 100);
    v.integer({"layer", "",
               "0 in front; a stage of another layer than the one before it starts anew from the first stage, and "
               "may pass behind the others"},
              layer, 0, 8);
    v.field_weights({"cost", "", "weights of fields in a node's cost"}, cost);
    v.number({"cost_constant", "", "constant part of a node's cost"}, cost_constant, -4, 20);
    v.number({"cost_power", "", "above 1 makes paths shun costly nodes"}, cost_power, 0.25f, 8);
    v.number({"cost_max", "", "this much cost is the dearest node"}, cost_max, 0.01f, 100);
    v.integer({"levels", "", "integer steps between the cheapest and the dearest node"}, levels, 2, 65535);
    v.number({"along_flow", "", "how much dearer it is to cross the picture's structures than to follow them"},
             along_flow, 0, 20);
    v.number({"down", "", "how much dearer it is to grow upwards than downwards"}, down, 0, 20);
    v.number({"up", "", "how much dearer it is to grow downwards than upwards"}, up, 0, 20);
    v.number({"wind", "", "how much dearer it is to grow to the left than to the right; negative: the reverse"}, wind,
             -20, 20);
    v.number({"noise_white", "", "weight of independent noise, another in every batch"}, noise_white, 0, 10);
    v.number({"noise_smooth", "", "weight of smooth noise, another in every batch: bends branches"}, noise_smooth, 0,
             10);
    v.number({"noise_scale", "u", "wavelength of the smooth noise"}, noise_scale, 2, 400);
    v.number({"bare", "u", "way from the root on which starting a branch costs more"}, bare, 0, 2000);
    v.number(
        {"turn_penalty", "", "not on unmoved squares: how much dearer an edge is that turns back; bends cost part"},
        turn_penalty, 0, 20);
    v.number({"earlier_paths", "",
              "what nodes on earlier paths cost, as a share: from the root, paths leave them at acos of it"},
             earlier_paths, 0, 1);
    v.integer({"batches", "", "rounds of growth, each seeing what the ones before have drawn"}, batches, 1, 64);
    v.number({"path_lack", "", "a path is grown only if wanted less drawn ink is more than this along it; -1: always"},
             path_lack, -1, 1);
    v.number({"path_longest", "u", "a longer path needs real lack of ink, 72 % of this in every further batch; 0: any"},
             path_longest, 0, 1000);
    v.text({"path_inside", "", "field that must be above 0.45 on nearly all of a path, or empty"}, path_inside);
    v.section("endpoints", "where paths must arrive", [this](ParameterVisitor& inner) { endpoints.visit(inner); });
}

void ChoiceParameters::visit(ParameterVisitor& v) {
    v.integer({"growths", "", "drawings grown; the one that shows the picture's features best is kept"}, growths, 1,
              32);
    v.number({"window", "u", "how finely they are compared with the picture"}, window, 0.5f, 100);
}

void SceneParameters::visit(ParameterVisitor& v) {
    static constexpr std::array<std::string_view, 4> kBlends{"over", "multiply", "screen", "soft-light"};
    choice(v, {"blend", "", "how the drawing's paint meets what it stands on, on any ground"}, blend, kBlends);
    v.number({"painted", "", "with --place: how coarsely the background is repainted with brushes; 0: not at all"},
             painted, 0, 1);
    v.number({"match", "", "how far the drawing's colours move into the background's shadows and lights"}, match, 0, 1);
    v.number({"backlight", "", "how far they darken where the background is darker than paper, as against the light"},
             backlight, 0, 1);
    v.number({"fade", "", "how far inside its place light has faded in, in shares of the place's shorter side"}, fade,
             0, 0.5f);
    v.flag({"stands", "", "its lowest root is on the place's bottom edge, and hidden by the ground before it"}, stands);
    v.number({"contact", "", "how dark the ground is at the feet"}, contact, 0, 1);
    v.number({"shadow", "", "how dark the shadow on the ground is"}, shadow, 0, 1);
    v.number({"shadow_x", "", "how far it falls to the right, per height of what casts it; negative: left"}, shadow_x,
             -4, 4);
    v.number({"shadow_y", "", "how far it falls towards the viewer; negative: away"}, shadow_y, -1, 1);
    v.number({"shadow_soft", "u", "blur of the shadow of what is far from the ground"}, shadow_soft, 0, 100);
    v.number({"foreground", "", "how high the ground's blades rise before the feet; 0: a level edge"}, foreground, 0,
             4);
}

void Style::visit(ParameterVisitor& v) {
    v.section("lattice", "what the dendrite grows on", [this](ParameterVisitor& inner) { lattice.visit(inner); });
    v.section("fields", "what is read off the picture", [this](ParameterVisitor& inner) { fields.visit(inner); });
    v.section("crown", "where it keeps to, and how far the picture leads",
              [this](ParameterVisitor& inner) { fields.crown.visit(inner); });
    v.section("root", "where growth starts", [this](ParameterVisitor& inner) { root.visit(inner); });
    for (StageParameters& stage : stages)
        v.section("stage." + stage.name, "one round of growth",
                  [&stage](ParameterVisitor& inner) { stage.visit(inner); });
    v.section("stroke", "branches to smooth centrelines", [this](ParameterVisitor& inner) { stroke.visit(inner); });
    v.section("width", "how wide strokes are", [this](ParameterVisitor& inner) { width.visit(inner); });
    v.section("choice", "the best of several drawings", [this](ParameterVisitor& inner) { choice.visit(inner); });
    v.section("scene", "how it joins a picture that it is put in",
              [this](ParameterVisitor& inner) { scene.visit(inner); });
    v.section(metaphor_name, "how strokes are dressed", [this](ParameterVisitor& inner) { metaphor->visit(inner); });
}

}  // namespace dstylize
