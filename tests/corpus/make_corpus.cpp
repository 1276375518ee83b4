// make_corpus FOLDER COUNT [FIRST]: whole pictures into FOLDER/sound, greedy ones into FOLDER/greedy, and COUNT damaged
// ones, numbered from FIRST, into FOLDER/damaged. The same numbers give the same bytes.
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "corpus/sound.h"
#include "support/picture_files.h"

int main(int count, char** words) {
    using namespace dstylize::test;
    if (count < 3) {
        std::fputs("make_corpus FOLDER COUNT [FIRST]\n", stderr);
        return 2;
    }
    const std::filesystem::path folder = words[1];
    for (const char* const kind : {"sound", "greedy", "damaged"}) std::filesystem::create_directories(folder / kind);
    const std::vector<CorpusFile> sound = sound_pictures(codec());
    for (const CorpusFile& file : sound) write_file(folder / "sound" / file.name, file.bytes);
    for (const CorpusFile& file : greedy_pictures()) write_file(folder / "greedy" / file.name, file.bytes);
    const std::uint64_t first = count > 3 ? std::strtoull(words[3], nullptr, 10) : 0;
    for (std::uint64_t n = first; n < first + std::strtoull(words[2], nullptr, 10); ++n) {
        const CorpusFile file = damaged_picture(sound, n);
        write_file(folder / "damaged" / file.name, file.bytes);
    }
    return 0;
}
