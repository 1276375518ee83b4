#pragma once
#include <cstdint>
#include <vector>

#include "pipeline/scene.h"

namespace dstylize {

// Below, `px_per_list` is how many of the ground's pixels go to one of the scene's frame.

/// Lays the shadow that the drawing casts, and the darkness around its feet. `drawing` is in its own frame.
void shade_ground(Picture& ground, float px_per_list, const DisplayList& drawing, const std::vector<Foot>& feet,
                  const Placement& placement, const SceneParameters& parameters, const Work& work);

/// The ground's own pixels in front of the drawing: all below the lowest foot inside the drawing's frame, and
/// blades of them before every foot. Elsewhere transparent.
Picture foreground(const Picture& ground, float px_per_list, const DisplayList& drawing, const std::vector<Foot>& feet,
                   const Placement& placement, float blades, std::uint64_t seed);

/// Strokes of light fade out towards those edges of the drawing's frame that lie inside the ground's, over the
/// share `fade` of its shorter side: light knows no frame. `drawing` is the extent of the drawing's own frame.
void fade_light(DisplayList& placed, Vec2f drawing, const Placement& placement, float fade);

/// Colours of the list between the shadows and the lights that the ground has around the box, by a share of
/// `match`, and by `backlight` darker the darker it is there; layers that are of the ground get the ground's colours
/// where they grow.
void match_colours(DisplayList& placed, const Picture& ground, float px_per_list, const Box& box,
                   const SceneParameters& parameters);

}  // namespace dstylize
