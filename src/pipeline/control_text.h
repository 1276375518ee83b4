#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/controls.h"

namespace dstylize {

/// Controls as users write them.

/// "x,y" (each a fraction with a decimal point, or a pixel), or bottom, top, centre, darkest.
/// Throws Error(bad_usage).
RootChoice parsed_root(std::string_view text);
/// The text that gives this root again.
std::string root_text(const RootChoice& root);

/// Numbers with commas between them, each as in a root; empty when one is none.
std::vector<Coordinate> parsed_coordinates(std::string_view text);
/// The text that gives this coordinate again.
std::string coordinate_text(Coordinate coordinate);

/// The rows of an endpoints file: "x,y" or "x,y,STAGE" a line, coordinates as for roots. Empty lines,
/// lines that begin with # and one heading line "x,y..." are skipped. `name` is the file's name for messages.
/// Throws Error(cannot_read) with the line for anything else, and when there is no row.
std::vector<EndpointRow> endpoint_rows(std::string_view text, const std::string& name);

/// Throws Error(cannot_read) for the first row that lies outside the picture or names none of the stages.
void check_endpoints(const std::vector<EndpointRow>& rows, Extent picture_px, const std::vector<std::string>& stages,
                     const std::string& name);

/// "#rrggbb", or nothing.
std::optional<Rgba> parsed_colour(std::string_view text);
std::string colour_text(Rgba colour);

}  // namespace dstylize
