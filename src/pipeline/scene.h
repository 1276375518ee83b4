#pragma once
#include <cstdint>
#include <vector>

#include "core/display_list.h"
#include "core/picture.h"
#include "core/work.h"
#include "pipeline/place.h"
#include "pipeline/style.h"

namespace dstylize {

struct Drawing;

/// Where a drawing comes to lie in a background: a point of its frame times `scale` plus `shift_px`. It keeps its
/// proportions, is as large as fits into the box and stands on the middle of its bottom edge: with its lowest
/// root where it `stands`, else with its frame.
struct Placement {
    float scale = 1;
    Vec2f shift_px;
    Vec2f placed(Vec2f p) const { return p * scale + shift_px; }
};

/// A root on the ground, in the drawing's frame.
struct Foot {
    Vec2f at_px;
    float width_px = 0;
};
/// The roots of a drawing, the lowest first.
std::vector<Foot> feet(const Drawing& drawing);

Placement placement(const DisplayList& drawing, const std::vector<Foot>& feet, const Box& box, bool stands);

/// The same strokes elsewhere: every length of the list, scaled, but its paper, in a frame of the given size.
DisplayList moved(DisplayList drawing, const Placement& placement, Extent frame_px);

/// The drawing in the background, whose frame becomes the list's: the background (at most 4096 pixels on the
/// long side, 2048 where it is painted) is the paper's picture with the drawing's shadow on it, colours are
/// matched, and where the drawing stands a cover of the ground's own pixels hides what reaches below it. The
/// drawing's own paper is left out.
DisplayList in_scene(const Drawing& drawing, const Picture& background, const Box& box,
                     const SceneParameters& parameters, std::uint64_t seed, const Work& work);

/// Bytes that in_scene needs beside the drawing, and what of them its result keeps. Measured, and rounded up.
struct SceneMemory {
    double peak = 0, kept = 0;
};
SceneMemory scene_memory(Extent background_px, const SceneParameters& parameters);

}  // namespace dstylize
