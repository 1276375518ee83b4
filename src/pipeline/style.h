#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/lattice.h"
#include "graph/planner.h"
#include "importance/fields.h"
#include "metaphor/metaphor.h"
#include "stroke/strokes.h"
#include "stroke/widths.h"

namespace dstylize {

/// What the dendrite grows on: the [lattice] table.
struct LatticeParameters {
    enum class Kind { regular, hexagon, scattered };
    Kind kind = Kind::regular;
    int detail = 1024;  ///< nodes on the picture's long side
    Neighbourhood neighbourhood = Neighbourhood::square8;
    float jitter = 0;  ///< how far nodes are moved, in half steps; scattered ones always are by up to 1
    float margin = 5;  ///< u: nothing grows this near to the frame
    float stem = 0;    ///< u: with a mask, how wide its strokes are; 0: u is 1/1024 of the long side
    float picture_scale = 1, picture_x = 0.5f, picture_y = 0.5f;  ///< the picture inside the frame

    void visit(ParameterVisitor& visitor);
};

/// Where growth starts unless the user says: the [root] table.
struct RootParameters {
    enum class Place { bottom, top, centre, darkest };
    Place place = Place::bottom;
    float centring = 0.35f;               ///< how much a place in the middle counts against an important one
    float inset = 16;                     ///< u: distance from the frame of `bottom` and `top`
    std::string interest = "importance";  ///< field: where it is high roots are best
    float smallest_part = 9;              ///< u^2: smaller connected parts get no root
    bool every_part = false;              ///< parts without a root of the user's get one of their own

    void visit(ParameterVisitor& visitor);
};

/// Where paths must arrive: a stage's [stage.endpoints] table. Lengths in u.
struct EndpointParameters {
    enum class Rule { stipples, discs, above };
    Rule rule = Rule::discs;
    std::string density = "density";  ///< field: 0 calm spacing, 1 dense spacing
    float density_blur = 0, density_exponent = 1, density_toe = 0;
    std::string priority = "density";  ///< discs: field, highest first
    float at_least = 0, jitter = 0;
    float calm_spacing = 26, dense_spacing = 3;
    float close_loops = 0;    ///< u: ways around a hole longer than this are joined; 0: never
    float keep_off = 0;       ///< discs: share of the spacing to keep from what is drawn already
    float first_spacing = 1;  ///< the first batch's spacings as a multiple of the last's
    int most = 0;             ///< at most so many in the first batch, the later ones as spacings allow; 0: any number
    float within = 0;         ///< edges (at 1024 nodes) from the structure; 0: anywhere
    float reach = 300;        ///< above: u from the root

    void visit(ParameterVisitor& visitor);
};

/// One round of growth: a [[stage]] table.
struct StageParameters {
    enum class Sources { root, dendrite };
    std::string name = "growth";
    Metric metric = Metric::max_sum;
    int blend_factor = 5000;
    Sources sources = Sources::root;
    float carry = 0, carry_cost = 0;
    int layer = 0;
    FieldWeights cost;
    float cost_constant = 1, cost_power = 1, cost_max = 1;
    int levels = 255;
    float along_flow = 0;
    float down = 0;
    float up = 0, wind = 0;
    float noise_white = 0, noise_smooth = 0, noise_scale = 36;
    float bare = 0;
    float turn_penalty = 0;
    float earlier_paths = 1;
    int batches = 1;
    float path_lack = -1, path_longest = 0;
    std::string path_inside;
    EndpointParameters endpoints;

    void visit(ParameterVisitor& visitor);
};

/// How many drawings are grown and which one is kept: the [choice] table.
struct ChoiceParameters {
    int growths = 1;
    float window = 5;

    void visit(ParameterVisitor& visitor);
};

/// How a drawing joins the picture it is put in: the [scene] table. `blend` counts on any ground, the rest for
/// a drawing with a Place only. (Long & Mould 2009, s. 5.4, compose by hand.)
struct SceneParameters {
    Mixing blend = Mixing::over;
    float painted = 0.5f;
    float match = 0.5f;
    float backlight = 0;
    float fade = 0.25f;
    bool stands = false;
    float contact = 0.6f;
    float shadow = 0.5f;
    float shadow_x = 0.6f, shadow_y = 0.14f;
    float shadow_soft = 5;
    float foreground = 1;

    void visit(ParameterVisitor& visitor);
};

/// A style with every parameter in place: what a file in filters/ says, nothing left to default later.
struct Style {
    std::string name;
    std::string summary;
    LatticeParameters lattice;
    FieldParameters fields;
    RootParameters root;
    std::vector<StageParameters> stages;
    StrokeParameters stroke;
    WidthParameters width;
    ChoiceParameters choice;
    SceneParameters scene;
    std::string metaphor_name;
    std::unique_ptr<Metaphor> metaphor;

    /// Shows every table in the order of a style file.
    void visit(ParameterVisitor& visitor);
};

}  // namespace dstylize
