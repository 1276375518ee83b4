// Any text is a style or an Error; what a style is written as reads back as the same style.
#include <cstddef>
#include <cstdint>

#include "core/error.h"
#include "law.h"
#include "pipeline/style_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        dstylize::Style style = dstylize::parse_style({reinterpret_cast<const char*>(data), size}, "style.toml");
        const std::string written = dstylize::style_toml(style);
        dstylize::Style again = dstylize::parse_style(written, "written.toml");
        law(dstylize::style_toml(again) == written, "a written style reads back");
    } catch (const dstylize::Error& error) {
        law(error.file() != "written.toml", "a written style can be read");
    }
    return 0;
}
