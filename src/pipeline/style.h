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
    int detail = 1024;  ///< nodes on the picture's long side
    Neighbourhood neighbourhood = Neighbourhood::square8;
    float margin = 5;  ///< u: nothing grows this near to the frame
    float stem = 0;    ///< u: with a mask, how wide its strokes are; 0: u is 1/1024 of the long side

    void visit(ParameterVisitor& visitor);
};

/// Where growth starts unless the user says: the [root] table.
struct RootParameters {
    enum class Place { bottom, top, centre, darkest };
    Place place = Place::bottom;
    float inset = 16;                     ///< u: distance from the frame of `bottom` and `top`
    std::string interest = "importance";  ///< field: where it is high roots are best
    float smallest_part = 9;              ///< u^2: smaller connected parts get no root
    bool every_part = false;              ///< parts without a root of the user's get one of their own

    void visit(ParameterVisitor& visitor);
};

/// Where paths must arrive: a stage's [stage.endpoints] table. Lengths in u.
struct EndpointParameters {
    enum class Rule { stipples, discs };
    Rule rule = Rule::discs;
    std::string density = "density";  ///< field: 0 calm spacing, 1 dense spacing
    float density_blur = 0, density_exponent = 1, density_toe = 0;
    std::string priority = "density";  ///< discs: field, highest first
    float at_least = 0, jitter = 0;
    float calm_spacing = 26, dense_spacing = 3;
    float close_loops = 0;  ///< u: ways around a hole longer than this are joined; 0: never
    float keep_off = 0;     ///< discs: share of the spacing to keep from what is drawn already

    void visit(ParameterVisitor& visitor);
};

/// One round of growth: a [[stage]] table.
struct StageParameters {
    enum class Sources { root, dendrite };
    std::string name = "growth";
    Metric metric = Metric::max_sum;
    int blend_factor = 5000;
    Sources sources = Sources::root;
    float carry = 0;
    FieldWeights cost;
    float cost_constant = 1, cost_power = 1, cost_max = 1;
    int levels = 255;
    float along_flow = 0;
    float down = 0;
    EndpointParameters endpoints;

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
    std::string metaphor_name;
    std::unique_ptr<Metaphor> metaphor;

    /// Shows every table in the order of a style file.
    void visit(ParameterVisitor& visitor);
};

}  // namespace dstylize
