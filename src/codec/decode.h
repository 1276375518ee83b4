#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "codec/byte_reader.h"
#include "codec/container.h"
#include "codec/upright.h"
#include "core/grid.h"
#include "ipc/codec_protocol.h"
#include "ipc/descriptor.h"
#include "ipc/shared_memory.h"

namespace dstylize::codec {

struct Limits {
    std::uint64_t max_memory_bytes = 0;
    bool allow_damaged = false;
};

struct Decoded {
    Extent extent;
    bool has_alpha = false;
    double dpi = 0;
    ipc::MetadataText text;
    ipc::Descriptor pixels;  ///< memory of extent.count() Rgba8
};

/// Decodes a picture file that lies in memory: `bytes` is the content of `file`. Throws Refusal, and
/// whatever the decoders throw.
Decoded decoded(Bytes bytes, const ipc::Descriptor& file, const Limits& limits);

/// Fills in what is carried besides pixels, where OpenImageIO has not read the file.
void carry(const EmbeddedMetadata& embedded, const std::optional<TiffDirectory>& exif, Decoded& decoded);

/// Refuses sizes of zero and those that need more than the limit: 4 bytes a pixel on each side of the
/// channel, and `extra_pixel_bytes` where a decoder holds the whole picture itself.
void check_size(Extent stored, std::uint64_t extra_pixel_bytes, const Limits& limits);

/// The memory that takes an upright picture row by row.
class PictureSink {
  public:
    PictureSink(Extent stored, int orientation);
    const Upright& upright() const { return upright_; }
    void place(std::span<const Rgba8> rows, int first_row) { upright_.place(rows, first_row, pixels()); }
    /// The same for rows of `width` pixels that begin at (x, y) of the stored picture, cut to it.
    void place_part(std::span<const Rgba8> rows, int width, int x, int y);
    std::span<Rgba8> pixels() const;
    ipc::Descriptor take() { return std::move(memory_); }

  private:
    Extent stored_;
    Upright upright_;
    ipc::Descriptor memory_;
    ipc::Mapping mapping_;
};

}  // namespace dstylize::codec
