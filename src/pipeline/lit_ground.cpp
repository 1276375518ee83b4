#include "pipeline/lit_ground.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "imaging/filters.h"
#include "render/raster.h"

namespace dstylize {
namespace {

float mean_emission(const Item& item) {
    const auto* stroke = std::get_if<VariableStroke>(&item);
    if (!stroke || stroke->emission.empty()) return 1;
    return std::accumulate(stroke->emission.begin(), stroke->emission.end(), 0.0f) / float(stroke->emission.size());
}

/// The strokes of a glowing layer in the colours that its core would have on black.
Layer core_strokes(const Layer& layer) {
    constexpr float kLevels = 24;  // of brightness: few colours make few groups
    const Glow& glow = *layer.glow;
    const auto exposed = [&](float light) { return 1 - std::exp(-glow.exposure * glow.core_gain * light); };
    std::vector<std::pair<float, const Item*>> by_light;
    for (const Item& item : layer.items)
        by_light.emplace_back(std::ceil(mean_emission(item) * kLevels) / kLevels, &item);
    std::stable_sort(by_light.begin(), by_light.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    Layer out{layer.name, layer.blend, {}, Glow{}};
    out.glow->core_gain = 0;  // what it adds beside its strokes is in the ground
    for (const auto& [light, item] : by_light) {
        const Rgba lit{exposed(light * glow.core.r), exposed(light * glow.core.g), exposed(light * glow.core.b), 1};
        out.items.push_back(*item);
        std::visit([&lit](auto& it) { it.colour = lit; }, out.items.back());
    }
    return out;
}

}  // namespace

DisplayList with_lit_ground(const DisplayList& list, int most_px, const Work& work) {
    const auto is_effect = [](const Layer& layer) { return layer.glow || layer.relief; };
    const auto last = std::find_if(list.layers.rbegin(), list.layers.rend(), is_effect);
    if (last == list.layers.rend()) return list;
    const auto above = last.base();

    DisplayList ground{list.width_px, list.height_px, list.paper, {list.layers.begin(), above}, list.mixing};
    for (Layer& layer : ground.layers)
        if (layer.glow) layer.glow->core_gain = 0;
    const float scale = std::min(1.0f, float(most_px) / std::max(list.width_px, list.height_px));
    const auto side = [scale](float px) { return std::max(1, int(std::lround(px * scale))); };
    const Extent size{side(list.width_px), side(list.height_px)};
    if (ground.paper.picture) ground.paper.picture = std::make_shared<Picture>(resized(*ground.paper.picture, size));

    DisplayList out{list.width_px, list.height_px, list.paper, {}, list.mixing, list.cover};
    out.paper.grain = 0;
    out.paper.picture = std::make_shared<Picture>(raster(ground, {size}, work));
    for (auto layer = list.layers.begin(); layer != above; ++layer)
        if (layer->glow) out.layers.push_back(core_strokes(*layer));
    out.layers.insert(out.layers.end(), above, list.layers.end());
    return out;
}

}  // namespace dstylize
