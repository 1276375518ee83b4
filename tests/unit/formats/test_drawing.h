#pragma once
#include <cmath>
#include <numbers>

#include "core/display_list.h"
#include "core/noise.h"

namespace dstylize::support {

/// What the vector formats have to get right, on 320 x 240: leaves, a trunk with twigs, curls, hairlines,
/// a zigzag, dots, a reversal and a translucent layer.
inline DisplayList test_drawing() {
    DisplayList list{320, 240, {{0.96f, 0.94f, 0.88f, 1}, 0, 0}, {}};
    const Rgba ink{0.12f, 0.15f, 0.1f, 1}, leaf{0.6f, 0.65f, 0.48f, 1}, glaze{0.7f, 0.3f, 0.2f, 0.5f};
    Layer leaves{"leaves", Blend::over, {}};
    for (int i = 0; i < 6; ++i) {
        Fill fill{{}, leaf};
        const float turn = 0.7f * float(i);
        for (int k = 0; k < 28; ++k) {
            const float t = 2 * std::numbers::pi_v<float> * float(k) / 28;
            const Vec2f p{16 * std::cos(t), 6 * std::sin(t)};
            fill.outline_px.push_back(
                Vec2f{230 + 13 * float(i), 40 + 9 * float(i)} +
                Vec2f{p.x * std::cos(turn) - p.y * std::sin(turn), p.x * std::sin(turn) + p.y * std::cos(turn)});
        }
        leaves.items.push_back(fill);
    }
    Layer strokes{"strokes", Blend::max, {}};
    const auto add = [&](std::vector<Vec2f> points, std::vector<float> widths, std::uint8_t stage,
                         std::uint16_t order) {
        strokes.items.push_back(VariableStroke{std::move(points), std::move(widths), ink, order, stage});
    };
    add({{60, 235}, {62, 180}, {58, 120}, {64, 60}, {70, 20}}, {10, 9, 7, 4, 0.5f}, 0, 0);
    for (int i = 0; i < 10; ++i) {
        const float y = 200 - 16 * float(i), side = i % 2 ? 1.0f : -1.0f;
        add({{61, y}, {61 + 12 * side, y - 12}, {61 + 30 * side, y - 16}, {61 + 48 * side, y - 30}}, {4, 3, 1.5f, 0.3f},
            0, 1);
        add({{61 + 30 * side, y - 16}, {61 + 40 * side, y - 14}, {61 + 50 * side, y - 19}}, {1.2f, 0.8f, 0.3f}, 1, 2);
    }
    VariableStroke spiral{{}, {}, ink, 0, 1};
    for (int i = 0; i < 90; ++i) {
        const float a = 0.2f * float(i), r = 3 + 0.4f * float(i);
        spiral.points_px.push_back({170 + r * std::cos(a), 90 + r * std::sin(a)});
        spiral.width_px.push_back(0.4f + 0.05f * float(i));
    }
    strokes.items.push_back(spiral);
    for (int i = 0; i < 24; ++i) {
        const float x = 130 + 3 * float(i);
        add({{x, 150}, {x + 8, 225}}, {0.7f, 0.7f}, 1, 3);
    }
    add({{220, 150}, {232, 190}, {244, 150}, {256, 190}, {268, 150}, {280, 190}}, {8, 7, 6, 4, 3, 1}, 1, 0);
    add({{225, 215}, {300, 215}, {260, 215}}, {5, 5, 5}, 1, 0);
    add({{305, 170}}, {9}, 1, 0);
    Layer wash{"wash & glaze", Blend::max, {}};
    wash.items = {VariableStroke{{{110, 20}, {200, 60}, {300, 150}}, {14, 10, 6}, glaze, 0, 0},
                  VariableStroke{{{120, 90}, {200, 60}, {290, 20}}, {14, 10, 6}, glaze, 0, 0}};
    list.layers = {std::move(leaves), std::move(strokes), std::move(wash)};
    return list;
}

/// A sheet full of curly strokes as a vine has them: for sizes of files.
inline DisplayList many_strokes(int count, int points) {
    DisplayList list{1024, 768, {}, {}};
    Layer layer{"strokes", Blend::max, {}};
    const Noise noise(7, Purpose::jitter);
    std::uint64_t draw = 0;
    for (int s = 0; s < count; ++s) {
        VariableStroke stroke;
        Vec2f at{1024 * noise.unit(draw), 768 * noise.unit(draw + 1)};
        float heading = 6.28f * noise.unit(draw + 2);
        const float bend = 0.4f * (noise.unit(draw + 3) - 0.5f),
                    width = 0.6f + 3 * std::pow(noise.unit(draw + 4), 3.0f);
        draw += 5;
        for (int i = 0; i < points; ++i) {
            stroke.points_px.push_back(at);
            stroke.width_px.push_back(std::max(0.45f, width * (1 - float(i) / float(points))));
            at = at + Vec2f{std::cos(heading), std::sin(heading)} * 0.9f;
            heading += bend;
        }
        layer.items.push_back(std::move(stroke));
    }
    list.layers.push_back(std::move(layer));
    return list;
}

}  // namespace dstylize::support
