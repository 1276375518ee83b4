#pragma once
#include <string>
#include <string_view>

#include "core/vec.h"
#include "pipeline/controls.h"

namespace dstylize {

/// Where in a background picture a drawing stands, as a user says it: a box by its upper left corner and its size.
struct Place {
    Coordinate x, y, width, height;
};

/// "x,y,w,h": fractions of the background where they have a decimal point, else its pixels.
/// Throws Error(bad_usage), also for a width or height of zero.
Place parsed_place(std::string_view text);
/// The text that gives this place again.
std::string place_text(const Place& place);

/// The box in pixels of the background.
struct Box {
    Vec2f corner_px, size_px;
};
/// Throws Error(bad_usage) when the box does not lie inside the background.
Box placed_box(const Place& place, Extent background_px);

}  // namespace dstylize
