// The raster at the sizes people ask for: a drawing like a full vine (25,000 strokes, 500,000 points).
#include <benchmark/benchmark.h>

#include <cmath>

#include "core/noise.h"
#include "formats/document.h"
#include "render/raster.h"

namespace dstylize {
namespace {

constexpr int kStrokes = 25000, kPointsPerStroke = 20;

/// Curly tapered strokes all over a picture of 6000 x 4000; widths and spacings as a vine has them.
DisplayList vine_like() {
    constexpr float kWidth = 6000, kHeight = 4000, kUnit = kWidth / 1024;
    DisplayList list{kWidth, kHeight, {{0.96f, 0.94f, 0.88f, 1}, 0.02f, 1}, {}};
    Layer layer{"strokes", Blend::max, {}};
    const Noise noise(7, Purpose::jitter);
    std::uint64_t draw = 0;
    for (int s = 0; s < kStrokes; ++s) {
        VariableStroke stroke;
        stroke.colour = {0.13f, 0.15f, 0.1f, 1};
        Vec2f at{kWidth * noise.unit(draw++), kHeight * noise.unit(draw++)};
        float heading = 6.2831853f * noise.unit(draw++);
        const float bend = 0.4f * (noise.unit(draw++) - 0.5f),
                    width = (0.6f + 3 * std::pow(noise.unit(draw++), 3.0f)) * kUnit;
        for (int i = 0; i < kPointsPerStroke; ++i) {
            stroke.points_px.push_back(at);
            stroke.width_px.push_back(std::max(0.45f * kUnit, width * (1 - float(i) / kPointsPerStroke)));
            at = at + Vec2f{std::cos(heading), std::sin(heading)} * (0.9f * kUnit);
            heading += bend;
        }
        layer.items.push_back(std::move(stroke));
    }
    list.layers.push_back(std::move(layer));
    return list;
}

void raster_of_long_side(benchmark::State& state) {
    const DisplayList list = vine_like();
    const Extent size{int(state.range(0)), int(state.range(0) * 2 / 3)};
    for (auto _ : state) benchmark::DoNotOptimize(raster(list, {size}, {}));
    state.counters["Mpx/s"] =
        benchmark::Counter(double(size.count()) * 1e-6, benchmark::Counter::kIsIterationInvariantRate);
}
void svg_of_the_list(benchmark::State& state) {
    const DisplayList list = vine_like();
    std::size_t bytes = 0;
    for (auto _ : state) bytes = svg_document(list, {}).size();
    state.counters["MB"] = double(bytes) * 1e-6;
}

void pdf_of_the_list(benchmark::State& state) {
    const DisplayList list = vine_like();
    std::size_t bytes = 0;
    for (auto _ : state) bytes = pdf_document(list, {}).size();
    state.counters["MB"] = double(bytes) * 1e-6;
}

BENCHMARK(svg_of_the_list)->Unit(benchmark::kMillisecond);
BENCHMARK(pdf_of_the_list)->Unit(benchmark::kMillisecond);
BENCHMARK(raster_of_long_side)
    ->Arg(300)
    ->Arg(1024)
    ->Arg(2048)
    ->Arg(6000)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace
}  // namespace dstylize
