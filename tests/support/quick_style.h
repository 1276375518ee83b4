#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "pipeline/style_file.h"

namespace dstylize::test {

/// A style to be drawn at little detail: with coarse noise, since noise is made at the picture's own scale,
/// whatever the detail, and would take most of the time.
inline Style quick_style(const std::string& name, const std::vector<Setting>& settings) {
    constexpr float kCoarse_u = 150;
    Style style = load_style(name, settings);
    for (StageParameters& stage : style.stages) stage.noise_scale = std::max(stage.noise_scale, kCoarse_u);
    return style;
}

}  // namespace dstylize::test
