#include "pipeline/scene.h"

#include <algorithm>

#include "imaging/filters.h"
#include "pipeline/painter.h"
#include "pipeline/scene_ground.h"
#include "pipeline/stylize.h"

namespace dstylize {
namespace {

constexpr int kMostGround_px = 4096, kMostPainted_px = 2048;

/// The size at which a background is worked on.
Extent ground_extent(Extent background, const SceneParameters& parameters) {
    const int most = parameters.painted > 0 ? kMostPainted_px : kMostGround_px;
    return background.long_side() <= most ? background : lattice_extent(background, most);
}

}  // namespace

std::vector<Foot> feet(const Drawing& drawing) {
    const float x = float(drawing.picture.x) / float(drawing.lattice.x);
    const float y = float(drawing.picture.y) / float(drawing.lattice.y);
    const float u_px = float(drawing.picture.long_side()) / 1024;
    std::vector<Foot> out;
    const Dendrite& d = drawing.dendrite;
    for (std::uint32_t v = 0; v < d.size(); ++v)
        if (d.is_root(v))
            out.push_back({{d.position_lattice[v].x * x, d.position_lattice[v].y * y}, drawing.width_u[v] * u_px});
    std::stable_sort(out.begin(), out.end(), [](const Foot& a, const Foot& b) { return a.at_px.y > b.at_px.y; });
    return out;
}

Placement placement(const DisplayList& drawing, const std::vector<Foot>& feet, const Box& box, bool stands) {
    const float bottom = stands && !feet.empty() ? feet[0].at_px.y : drawing.height_px;
    const float scale = std::min(box.size_px.x / drawing.width_px, box.size_px.y / std::max(bottom, 1.0f));
    return {scale,
            {box.corner_px.x + (box.size_px.x - scale * drawing.width_px) / 2,
             box.corner_px.y + box.size_px.y - scale * bottom}};
}

DisplayList moved(DisplayList list, const Placement& to, Extent frame_px) {
    const float old_side = std::max(list.width_px, list.height_px);
    const float shares = old_side * to.scale / float(frame_px.long_side());  // of the drawing's long side
    list.width_px = float(frame_px.x);
    list.height_px = float(frame_px.y);
    for (Layer& layer : list.layers) {
        for (Item& item : layer.items) {
            if (auto* fill = std::get_if<Fill>(&item)) {
                for (Vec2f& p : fill->outline_px) p = to.placed(p);
                continue;
            }
            auto& stroke = std::get<VariableStroke>(item);
            for (Vec2f& p : stroke.points_px) p = to.placed(p);
            for (float& w : stroke.width_px) w *= to.scale;
        }
        if (layer.glow) {
            for (Glow::Halo& halo : layer.glow->halos) halo.sigma *= shares;
            layer.glow->cast_sigma *= shares;
        }
        if (Relief* r = layer.relief ? &*layer.relief : nullptr)
            for (float* length : {&r->tip_length_px, &r->radius_px, &r->gap_sigma_px, &r->shadow_length_px,
                                  &r->shadow_sigma_px, &r->contact_sigma_px, &r->drape_sigma_px})
                *length *= to.scale;
    }
    return list;
}

DisplayList in_scene(const Drawing& drawing, const Picture& background, const Box& box,
                     const SceneParameters& parameters, std::uint64_t seed, const Work& work) {
    const std::vector<Foot> roots = parameters.stands ? feet(drawing) : std::vector<Foot>{};
    const Placement to = placement(drawing.list, roots, box, parameters.stands);
    const Extent size = ground_extent(background.extent(), parameters);
    Picture ground = size == background.extent() ? background : resized(background, size);
    const float px_per_list = float(ground.extent().long_side()) / float(background.extent().long_side());
    work.report("painting the background", 0);
    ground = brushed(ground, float(ground.extent().long_side()) / 1024, parameters.painted, seed, work);

    DisplayList out = moved(drawing.list, to, background.extent());
    fade_light(out, {drawing.list.width_px, drawing.list.height_px}, to, parameters.fade);
    match_colours(out, ground, px_per_list, box, parameters);
    if (!roots.empty()) {
        shade_ground(ground, px_per_list, drawing.list, roots, to, parameters, work);
        out.cover = std::make_shared<Picture>(
            foreground(ground, px_per_list, drawing.list, roots, to, parameters.foreground, seed));
    }
    out.paper = {};
    out.paper.picture = std::make_shared<Picture>(std::move(ground));
    return out;
}

SceneMemory scene_memory(Extent background, const SceneParameters& parameters) {
    // The painter holds planes of the picture and of the canvas, and up to four strokes for every 16 pixels; else
    // colours around the place are sorted. The ground and its cover are kept.
    constexpr double kPainted = 190, kPlain = 24, kKept = 8, kBackground = sizeof(Rgba8);
    const double pixels = double(ground_extent(background, parameters).count());
    return {double(background.count()) * kBackground + pixels * (parameters.painted > 0 ? kPainted : kPlain),
            pixels * kKept};
}

}  // namespace dstylize
