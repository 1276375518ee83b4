#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/display_list.h"
#include "formats/document.h"
#include "geometry/cubic_path.h"

namespace dstylize {

/// What SVG and PDF share: shapes as outlines, groups, page size, clean text.

/// One item as a filled path; empty when it covers nothing.
struct Shape {
    CubicPath path;
    Rgba colour;
};

/// Shapes that follow each other and belong to the same stage and branch order.
struct ShapeGroup {
    bool strokes = false;  ///< false: fills, which have no stage
    std::uint8_t stage = 0;
    std::uint16_t order = 0;
    std::vector<Shape> shapes;
};

/// A layer as vector formats paint it.
struct ShapeLayer {
    std::string name;
    /// Of the whole layer at once, then all its shapes are opaque; 1 when shapes have their own.
    float opacity = 1;
    bool one_colour = false;
    bool light = false;  ///< screened over what lies below
    std::vector<ShapeGroup> groups;
};

ShapeLayer shape_layer(const Layer& layer, float tolerance_px);

/// Shows every layer of the list in order, and where a group of layers begins and ends that is mixed with its
/// ground as one: those between two glowing ones, unless the list's mixing is `over`.
template <class Begin, class Show, class End>
void visit_layers(const DisplayList& list, float tolerance_px, Begin begin_group, Show show, End end_group) {
    bool in_group = false;
    for (const Layer& layer : list.layers) {
        const ShapeLayer shapes = shape_layer(layer, tolerance_px);
        const bool grouped = list.mixing != Mixing::over && !shapes.light;
        if (grouped && !in_group) begin_group();
        if (!grouped && in_group) end_group();
        in_group = grouped;
        show(shapes);
    }
    if (in_group) end_group();
}

/// How far shapes may leave the list: 0.05 u, but at least a 1/100 pixel, which is what is written.
float shape_tolerance_px(const DisplayList& list);

struct PageSize {
    double width_mm = 0, height_mm = 0;
};
/// The page as DocumentInfo describes it; all pixels at 96 dpi by default.
PageSize page_size(const DisplayList& list, const DocumentInfo& info);

/// The text of a key, or an empty one.
std::string_view text_of(const DocumentInfo& info, std::string_view key);

/// UTF-8 that every reader takes: malformed sequences and characters that XML forbids become U+FFFD.
std::string clean_text(std::string_view text);

}  // namespace dstylize
