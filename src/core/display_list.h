#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "core/picture.h"
#include "core/vec.h"

namespace dstylize {

/// A centreline with its full width at every point: a branch as the renderers draw it. The points are knots
/// of a smooth curve (geometry/tapered_line.h; a turn above 60 degrees stays a corner), drawn as tapered
/// capsules with round ends and joints, so that it is smooth at any size.
struct VariableStroke {
    std::vector<Vec2f> points_px;
    std::vector<float> width_px;  ///< one per point, full width
    Rgba colour;
    std::uint16_t order = 0;  ///< branch order: 0 leaves a root, n + 1 leaves a branch of order n
    std::uint8_t stage = 0;   ///< the stage that grew it
    std::uint8_t layer = 0;   ///< 0 in front, higher ones behind
};

/// A closed outline (implicitly closed polygon), filled, even-odd never needed.
struct Fill {
    std::vector<Vec2f> outline_px;
    Rgba colour;
};

using Item = std::variant<VariableStroke, Fill>;

/// How items of one layer meet each other: `over` in painting order; `max` keeps the largest coverage,
/// so that strokes of one colour join without a seam however they overlap.
enum class Blend { over, max };

/// A named group: an SVG group, later a plotter's pen. Layers are composited over one another in order.
struct Layer {
    std::string name;
    Blend blend = Blend::over;
    std::vector<Item> items;
};

/// The ground the drawing stands on.
struct Paper {
    Rgba colour{1, 1, 1, 1};  ///< alpha 0: transparent ground
    float grain = 0;          ///< relative lightness noise (standard deviation about this), raster only
    std::uint64_t seed = 0;   ///< of the grain
    /// In the colour's place, stretched over the frame; its transparent parts stay transparent.
    std::shared_ptr<const Picture> picture = nullptr;
};

/// A finished drawing as vectors in the picture frame; raster, SVG and PDF all draw this one list.
struct DisplayList {
    float width_px = 0, height_px = 0;
    Paper paper;
    std::vector<Layer> layers;
};

}  // namespace dstylize
