#pragma once
#include <cstdint>
#include <memory>
#include <optional>
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
    /// How brightly each point shines in a glowing layer, in [0, 1]; empty: 1 everywhere.
    std::vector<float> emission = {};
    std::uint8_t layer = 0;  ///< 0 in front, higher ones behind
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

/// What a layer's strokes do as light. Their emission E is blurred into halos B, all of it is added up and
/// exposed per channel like a film, and screened over what lies below:
///     light = core_gain * core * E + sum of gain * colour * B,   out = 1 - (1 - below)^m * exp(-exposure * light)
/// with m = ambient + cast * (E blurred by cast_sigma): below is dimmed, and lit up again near the strokes.
/// Sigmas are shares of the drawing's long side, so that every size of output glows alike.
struct Glow {
    struct Halo {
        float sigma = 0.01f;
        Rgba colour;
        float gain = 1;
    };
    Rgba core{1, 1, 1, 1};
    float core_gain = 1;
    std::vector<Halo> halos;
    float exposure = 1.35f;
    float ambient = 1;  ///< how much of the light of what lies below stays; 1: all
    float cast = 0, cast_sigma = 0.03f;
};

/// What a layer's strokes are as a body on the ground: rods, lit from one side, that cast a shadow, with a skin
/// between those that lie close. Vector formats hold it as a picture. Lengths in the list's pixels.
struct Relief {
    Rgba tip;                 ///< strokes turn from their colour to this one towards their ends
    float tip_length_px = 8;  ///< over about this length
    float radius_px = 3;      ///< of a typical stroke: the scale of the relief and of its roughness
    float height = 0.7f, roughness = 0.5f;
    Vec2f light{-0.55f, -0.65f};  ///< towards the light, y down
    float light_height = 0.75f, ambient = 0.34f;
    Rgba gap_colour;  ///< of what fills the gaps between strokes
    float gap = 0.8f, gap_sigma_px = 2.5f;
    float shadow = 0.55f, shadow_length_px = 3, shadow_sigma_px = 1.5f;
    float contact = 0.4f, contact_sigma_px = 10;
    float drape = 0, drape_sigma_px = 16;  ///< how much the body follows the brightness of the ground's grain
    std::uint64_t seed = 0;
};

/// A named group: an SVG group, later a plotter's pen. Layers are composited over one another in order.
struct Layer {
    std::string name;
    Blend blend = Blend::over;
    std::vector<Item> items;
    std::optional<Glow> glow = std::nullopt;      ///< set: the items are not paint but light; their colours say nothing
    std::optional<Relief> relief = std::nullopt;  ///< set: the strokes are a body
    bool of_ground = false;  ///< what grows on the ground, not on the subject: in a scene it has the scene's colours
};

/// The ground the drawing stands on.
struct Paper {
    Rgba colour{1, 1, 1, 1};  ///< alpha 0: transparent ground
    float grain = 0;          ///< relative lightness noise (standard deviation about this), raster only
    std::uint64_t seed = 0;   ///< of the grain
    /// In the colour's place, stretched over the frame; its transparent parts stay transparent.
    std::shared_ptr<const Picture> picture = nullptr;
};

/// How paint meets what lies below it, as the W3C's Compositing and Blending Level 1 defines it.
enum class Mixing { over, multiply, screen, soft_light };

/// A finished drawing as vectors in the picture frame; raster, SVG and PDF all draw this one list.
struct DisplayList {
    float width_px = 0, height_px = 0;
    Paper paper;
    std::vector<Layer> layers;
    /// Of all layers that follow each other, as one group; those of light or in relief have ways of their own.
    Mixing mixing = Mixing::over;
    /// Over everything, stretched over the frame: what stands before the drawing. Null: nothing.
    std::shared_ptr<const Picture> cover = nullptr;
};

}  // namespace dstylize
