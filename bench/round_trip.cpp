// round_trip PHOTO DRAWING OUT: what a run needs that draws nothing.
//
// Decodes PHOTO through the codec and encodes the pixels of DRAWING to OUT as dstylize does; reading DRAWING is
// needed to have those pixels, and its seconds are printed to be subtracted.
#include <chrono>
#include <cstdio>

#include "core/error.h"
#include "formats/files.h"
#include "formats/picture_codec.h"

using namespace dstylize;

int main(int argc, char** argv) try {
    if (argc != 4) {
        std::fputs("usage: round_trip PHOTO DRAWING OUT\n", stderr);
        return 2;
    }
    constexpr std::uint64_t kMostBytes = 1ull << 32;
    PictureCodec codec;
    codec.decode(read_file(argv[1], kMostBytes), argv[1]);
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const Picture drawing = codec.decode(read_file(argv[2], kMostBytes), argv[2]).picture;
    const std::chrono::duration<double> not_counted = Clock::now() - start;
    write_file_atomically(argv[3], codec.encode(drawing, {}, argv[3]));
    std::printf("%.3f\n", not_counted.count());
} catch (const Error& error) {
    std::fprintf(stderr, "round_trip: %s\n", error.what());
    return 1;
}
