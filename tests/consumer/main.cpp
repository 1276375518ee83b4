// A stranger's program: draws a vine over a picture of its own.
#include <pipeline/style_file.h>
#include <pipeline/stylize.h>

int main() {
    dstylize::Picture photo({160, 120});
    for (int j = 0; j < 120; ++j)
        for (int i = 0; i < 160; ++i) {
            const bool disc = (i - 80) * (i - 80) + (j - 60) * (j - 60) < 40 * 40;
            photo(i, j) = disc ? dstylize::Rgba8{40, 30, 20} : dstylize::Rgba8{220, 225, 230};
        }
    const dstylize::Style style = dstylize::load_style("vine", {{"lattice.detail", "240"}});
    return dstylize::stylize(photo, style, {}).strokes > 0 ? 0 : 1;
}
