#pragma once
#include <string>
#include <string_view>

#include "core/grid.h"

namespace dstylize {

/// The long side of the largest drawing.
inline constexpr int kLongestDrawing_px = 65535;

/// How large an output shall be, as a user says it. The drawing itself never depends on it.
struct OutputSize {
    enum class Kind {
        as_input,   ///< one output pixel for each pixel of the input
        long_side,  ///< `value` pixels on the long side
        scale,      ///< `value` times the input
        length,     ///< `value` mm on the long side
        paper,      ///< as large as fits into a sheet, turned as the picture is
    };
    static constexpr double kDefaultDpi = 300;

    Kind kind = Kind::as_input;
    double value = 0;
    double dpi = kDefaultDpi;  ///< of lengths and papers
    std::string paper;         ///< its name, lower case
    double paper_short_mm = 0, paper_long_mm = 0;
};

/// Understands "2400" (pixels on the long side), "150%", "30cm", "12in@600dpi", "297mm", "A3", "letter@150dpi".
/// Throws Error(bad_usage).
OutputSize parsed_output_size(std::string_view text);

/// The text that gives this size again; "" for as_input.
std::string output_size_text(const OutputSize& size);

/// The output's pixels, and how large they are when they are printed.
struct OutputFrame {
    Extent size_px;
    double dpi = 0;                      ///< 0: nobody said
    double width_mm = 0, height_mm = 0;  ///< 0: nobody said
};

/// Throws Error(bad_usage) when a side would have more than 65,535 pixels.
OutputFrame output_frame(const OutputSize& size, Extent picture_px);

}  // namespace dstylize
