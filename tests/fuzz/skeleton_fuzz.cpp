// Any text is a skeleton or an Error; a skeleton that was read is a sound forest and is written as it was.
#include <cstddef>
#include <cstdint>

#include "core/error.h"
#include "formats/skeleton.h"
#include "law.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    dstylize::Skeleton skeleton;
    try {
        skeleton = dstylize::read_skeleton_json({reinterpret_cast<const char*>(data), size});
    } catch (const dstylize::Error&) {
        return 0;
    }
    law(dstylize::first_fault(skeleton.dendrite).empty(), "a skeleton that is read is a forest");
    const std::string written = dstylize::skeleton_json(skeleton, {});
    law(dstylize::skeleton_json(dstylize::read_skeleton_json(written), {}) == written, "a written skeleton reads back");
    return 0;
}
