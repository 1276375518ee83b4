#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/work.h"
#include "formats/format.h"
#include "formats/picture_codec.h"
#include "pipeline/output_size.h"
#include "pipeline/stylize.h"

namespace dstylize {

/// How a drawing becomes files, whatever their format.
struct DeliveryOptions {
    OutputFrame frame;
    int quality = 92;          ///< jpg, webp: 1 to 100
    int compression = 1;       ///< png, tif: 0 to 9
    std::string title;         ///< of svg, pdf, json
    PictureMetadata metadata;  ///< what every format carries
};

/// Turns one drawing into the bytes of any number of files. Rasters once for all of them.
class Delivery {
  public:
    /// Paper grain is laid only where the output has at most 4 megapixels: it multiplies a file's size.
    Delivery(Drawing drawing, DeliveryOptions options, PictureCodec& codec);

    /// `name` is the file's name for messages. Throws Error.
    std::vector<std::byte> file(const OutputFormat& format, const std::string& name, const Work& work);

  private:
    std::vector<std::byte> picture_file(const OutputFormat& format, const std::string& name, const Work& work);
    std::vector<std::byte> document_file(const OutputFormat& format, const std::string& name, const Work& work);

    Drawing drawing_;
    DeliveryOptions options_;
    PictureCodec& codec_;
    std::optional<Picture> raster_;
};

/// The bytes of a picture file; what is transparent becomes white where the format holds no alpha.
std::vector<std::byte> picture_file(const Picture& picture, const OutputFormat& format, const DeliveryOptions& options,
                                    PictureCodec& codec, const std::string& name);

/// The most pixels along a side that files of the format can have.
int most_pixels(FormatId format);

}  // namespace dstylize
