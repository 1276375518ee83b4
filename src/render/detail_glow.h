#pragma once
#include <span>

#include "core/display_list.h"
#include "core/grid.h"
#include "core/picture.h"
#include "core/work.h"

namespace dstylize {

/// Emission per output pixel, in [0, 1]: coverage times emission, the largest of all strokes at each sample,
/// averaged over the pixel. `glowing`: layers of the list that shine together.
Grid<float> emission_plane(const DisplayList& list, std::span<const Layer> glowing, Extent size_px, const Work& work);

/// Adds the light of the emission to the picture, as Glow says. Where the picture is transparent, light
/// becomes a picture of its own: as opaque as its brightest channel. Beyond the two planes it holds one
/// copy per halo, reduced so far that its sigma is a few samples.
void expose(Picture& below, const Grid<float>& emission, const Glow& glow, const Work& work);

}  // namespace dstylize
