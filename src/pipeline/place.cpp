#include "pipeline/place.h"

#include <fmt/format.h>

#include "core/error.h"
#include "pipeline/control_text.h"

namespace dstylize {
namespace {

/// Edges lie between pixels, so a whole number is that many pixels from the picture's edge.
double edge_px(Coordinate c, int side_px) { return c.is_fraction ? c.value * side_px : c.value; }

}  // namespace

Place parsed_place(std::string_view text) {
    const std::vector<Coordinate> parts = parsed_coordinates(text);
    const auto refuse = [&](const char* problem) {
        throw Error(ErrorCode::bad_usage, "", fmt::format("--place {}: {}", text, problem),
                    "give x,y,w,h of a box in the background: 0.1,0.2,0.5,0.7 are fractions, 120,80,400,500 pixels");
    };
    if (parts.size() != 4) refuse("not a box");
    for (const Coordinate& c : parts)
        if (c.value < 0) refuse("a part is negative");
    if (!(parts[2].value > 0 && parts[3].value > 0)) refuse("its width or height is zero");
    return {parts[0], parts[1], parts[2], parts[3]};
}

std::string place_text(const Place& p) {
    return fmt::format("{},{},{},{}", coordinate_text(p.x), coordinate_text(p.y), coordinate_text(p.width),
                       coordinate_text(p.height));
}

Box placed_box(const Place& place, Extent background) {
    constexpr double kRounding_px = 1e-6;
    const double x = edge_px(place.x, background.x), width = edge_px(place.width, background.x);
    const double y = edge_px(place.y, background.y), height = edge_px(place.height, background.y);
    if (x + width > background.x + kRounding_px || y + height > background.y + kRounding_px)
        throw Error(ErrorCode::bad_usage, "",
                    fmt::format("--place {}: reaches outside the background, which has {} x {} pixels",
                                place_text(place), background.x, background.y),
                    "give a box inside it; fractions (0.1,0.2,0.5,0.7) fit any size");
    return {{float(x), float(y)}, {float(width), float(height)}};
}

}  // namespace dstylize
