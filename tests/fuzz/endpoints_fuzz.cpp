// Any text is a list of endpoints or an Error, and each line of it a root, a size and a background or one.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/error.h"
#include "law.h"
#include "pipeline/background.h"
#include "pipeline/control_text.h"
#include "pipeline/output_size.h"

namespace {

template <class F>
void allowed_to_fail(F f) {
    try {
        f();
    } catch (const dstylize::Error&) {
        // The text is wrong, and that was said.
    }
}

void one_line(std::string_view line) {
    allowed_to_fail([&] {
        const std::string root = dstylize::root_text(dstylize::parsed_root(line));
        law(dstylize::root_text(dstylize::parsed_root(root)) == root, "a root's text reads back");
    });
    allowed_to_fail([&] {
        const dstylize::OutputSize size = dstylize::parsed_output_size(line);
        const dstylize::OutputFrame frame = dstylize::output_frame(size, {640, 480});
        law(frame.size_px.x >= 1 && frame.size_px.x <= 65535 && frame.size_px.y >= 1 && frame.size_px.y <= 65535,
            "an output has 1 to 65,535 pixels a side");
    });
    allowed_to_fail([&] { dstylize::parsed_background(line); });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    allowed_to_fail([&] {
        const auto rows = dstylize::endpoint_rows(text, "endpoints.csv");
        law(!rows.empty(), "no rows is an error");
        dstylize::check_endpoints(rows, {640, 480}, {"contours", "tone"}, "endpoints.csv");
        for (const dstylize::EndpointRow& row : rows)
            law(row.x.px(640) >= 0 && row.x.px(640) <= 640 && row.y.px(480) >= 0 && row.y.px(480) <= 480,
                "checked endpoints lie in the picture");
    });
    one_line(text.substr(0, text.find('\n')));
    return 0;
}
