#pragma once
#include <cstdint>
#include <string>

#include "core/grid.h"
#include "core/vec.h"

namespace dstylize {

/// Words to be set in type. Ligatures, accents, right-to-left scripts and characters that only another
/// installed font has are the business of Pango, which lays the text out.
struct Lettering {
    enum class Align { left, centre, right };
    std::string text;                       ///< UTF-8; \n breaks lines
    std::string font = "DejaVu Sans Bold";  ///< family and face of any installed font
    Align align = Align::centre;
    float letter_spacing = 0.04f;  ///< added between letters, in em
    float line_spacing = 1;        ///< distance of baselines, 1: the font's own
};

/// The box of the letters' ink at a font size of 1, relative to the place where the layout starts.
struct InkBox {
    float left = 0, top = 0, width = 0, height = 0;
};

/// Throws Error(bad_usage) when the text is empty, is not UTF-8, has no ink, or has a character that no
/// installed font can draw, and when no font of that name is installed.
InkBox ink_box(const Lettering& lettering);

/// Coverage of the letters in [0, 255], their ink box centred on `centre_px`, at `em_px` pixels to the em.
/// What lies outside the frame is cut off. Throws as ink_box does.
Grid<std::uint8_t> text_mask(const Lettering& lettering, Extent frame_px, float em_px, Vec2f centre_px);

}  // namespace dstylize
