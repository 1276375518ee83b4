#pragma once
#include <filesystem>
#include <string>

namespace dstylize {

/// What `dstylize styles` prints: every style and its summary, a line for each, the user's own last. A file
/// in the user's folder that is no style is listed with what is wrong with it.
std::string styles_description(const std::filesystem::path& user_folder);

/// What `dstylize styles --fields` prints: every field that a style or --show can name, and what it is.
std::string fields_description();

}  // namespace dstylize
