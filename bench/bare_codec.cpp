// bare_codec PHOTO DRAWING OUT: what OpenImageIO alone needs for the pictures of a run.
//
// Decodes PHOTO and encodes the pixels of DRAWING to OUT as dstylize does (8 bits, PNG at compression 1), and
// nothing else; reading DRAWING is needed to have those pixels, and its seconds are printed to be subtracted.
#include <OpenImageIO/imageio.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace {

struct Pixels {
    OIIO::ImageSpec spec;
    std::vector<std::uint8_t> bytes;
};

bool decode(const std::string& path, Pixels& out) {
    const auto in = OIIO::ImageInput::open(path);
    if (!in) return false;
    out.spec = in->spec();
    out.bytes.resize(std::size_t(out.spec.width) * std::size_t(out.spec.height) * std::size_t(out.spec.nchannels));
    return in->read_image(0, 0, 0, out.spec.nchannels, OIIO::TypeDesc::UINT8, out.bytes.data());
}

bool encode(const std::string& path, const Pixels& pixels) {
    const auto out = OIIO::ImageOutput::create(path);
    OIIO::ImageSpec spec(pixels.spec.width, pixels.spec.height, pixels.spec.nchannels, OIIO::TypeDesc::UINT8);
    spec["png:compressionLevel"] = 1;
    return out && out->open(path, spec) && out->write_image(OIIO::TypeDesc::UINT8, pixels.bytes.data()) && out->close();
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4) {
        std::fputs("usage: bare_codec PHOTO DRAWING OUT\n", stderr);
        return 2;
    }
    Pixels photo, drawing;
    const bool have_photo = decode(argv[1], photo);
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const bool have_drawing = decode(argv[2], drawing);
    const std::chrono::duration<double> not_counted = Clock::now() - start;
    if (!have_photo || !have_drawing || !encode(argv[3], drawing)) {
        std::fprintf(stderr, "bare_codec: %s\n", OIIO::geterror().c_str());
        return 1;
    }
    std::printf("%.3f\n", not_counted.count());
}
