#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace dstylize {

/// The pictures of a folder and of the folders in it, as paths from it, in the order of their names' bytes. Known by
/// their extensions (png jpg jpeg tif tiff webp bmp gif pnm ppm pgm pbm hdr exr, upper or lower case), or by any of
/// `patterns` where there are some: shell patterns as *.jpg, of the name alone or, with a slash, of the path from the
/// folder. Left out: what begins with a dot, links to folders, and the folder `leave_out`.
/// Throws Error(cannot_read) when the folder, or one in it, cannot be listed.
std::vector<std::filesystem::path> pictures_in(const std::filesystem::path& folder,
                                               const std::vector<std::string>& patterns,
                                               const std::filesystem::path& leave_out);

}  // namespace dstylize
