#include "pipeline/background.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"
#include "pipeline/control_text.h"

namespace dstylize {

Background parsed_background(std::string_view text) {
    if (text == "input") return {Background::Kind::input, {}, {}};
    if (text == "none") return {Background::Kind::none, {}, {}};
    if (const auto colour = parsed_colour(text)) return {Background::Kind::colour, *colour, {}};
    if (text.empty() || text.front() == '#')
        throw Error(ErrorCode::bad_usage, "", "--background " + std::string(text) + ": not a colour",
                    "give input, none, #rrggbb or a picture");
    return {Background::Kind::file, {}, std::filesystem::path(text)};
}

Picture middle_part(const Picture& picture, Extent frame) {
    const Extent whole = picture.extent();
    const double scale = std::min(double(whole.x) / frame.x, double(whole.y) / frame.y);
    const Extent part{std::clamp(int(std::lround(frame.x * scale)), 1, whole.x),
                      std::clamp(int(std::lround(frame.y * scale)), 1, whole.y)};
    if (part == whole) return picture;
    const int left = (whole.x - part.x) / 2, top = (whole.y - part.y) / 2;
    Picture out(part);
    for (int y = 0; y < part.y; ++y) std::copy_n(picture.row(top + y) + left, part.x, out.row(y));
    return out;
}

}  // namespace dstylize
