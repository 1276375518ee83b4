// Any bytes, given to the running codec as the program gives them, are a picture or an Error that names the file, and
// the next whole picture is read whatever became of the codec. OpenImageIO crashes on some; that is what the codec's
// process is for, so the fuzzer looks at our side of the channel.
#include <cstddef>
#include <cstdint>
#include <string>

#include "core/error.h"
#include "formats/picture_codec.h"
#include "law.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace dstylize;
    static PictureCodec codec({DSTYLIZE_CODEC, 256u << 20, 5, false});
    try {
        const DecodedPicture decoded = codec.decode({reinterpret_cast<const std::byte*>(data), size}, "fuzzed");
        law(!decoded.picture.empty(), "a picture has pixels");
    } catch (const Error& error) {
        law(error.code() == ErrorCode::cannot_read, error.what());
        law(error.file() == "fuzzed", "the file is named");
        law(std::string(error.what()).find('\n') == std::string::npos, "an error is one line");
    }
    static unsigned runs = 0;
    if (++runs % 64 != 0) return 0;
    constexpr char kWhole[] = "P5\n2 1\n255\n\x10\xf0";
    const DecodedPicture whole = codec.decode({reinterpret_cast<const std::byte*>(kWhole), sizeof kWhole - 1}, "whole");
    law(whole.picture.extent() == Extent{2, 1}, "the next whole picture is read");
    return 0;
}
