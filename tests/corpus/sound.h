#pragma once
#include <string>
#include <vector>

#include "core/grid.h"
#include "unit/formats/picture_files.h"

namespace dstylize::test {

/// A picture file for the tests of reliability.
struct CorpusFile {
    std::string name;  ///< with an extension
    FileBytes bytes;
    Extent extent;  ///< upright; zero where no picture is owed
};

/// Small whole pictures in every format that is read, the common ones in several kinds.
std::vector<CorpusFile> sound_pictures(PictureCodec& codec);

/// Files of a few hundred bytes that ask for gigabytes, or for hours: the largest sides that a header can state, and
/// data that unpacks to thousands of times its size.
std::vector<CorpusFile> greedy_pictures();

/// The sound picture with the number-th damage: bytes cut off, turned, repeated, left out, put in, or numbers that lie.
/// The same arguments give the same bytes. It may still be a whole picture.
CorpusFile damaged_picture(const std::vector<CorpusFile>& sound, std::uint64_t number);

}  // namespace dstylize::test
