#pragma once
#include <span>

#include "core/picture.h"
#include "ipc/codec_protocol.h"
#include "ipc/descriptor.h"

namespace dstylize::codec {

/// A finished drawing and what it is to become.
struct Drawing {
    Extent extent;
    std::span<const Rgba8> pixels;
    double dpi = 0;
    ipc::MetadataText text;
};

/// The memory that holds the picture file. Throws Refusal.
ipc::Descriptor encoded(const Drawing& drawing, const ipc::EncodeSettings& settings);

}  // namespace dstylize::codec
