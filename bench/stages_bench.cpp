// What each stage of a vine costs on a sample picture at the style's own detail, and every metric on the
// lattice that its first stage plans on.
#include <benchmark/benchmark.h>

#include <string>

#include "formats/files.h"
#include "formats/picture_codec.h"
#include "graph/bucket_planner.h"
#include "graph/graph_distance.h"
#include "graph/tile_planner.h"
#include "pipeline/growth.h"
#include "pipeline/prepared_picture.h"
#include "pipeline/style_file.h"
#include "pipeline/stylize.h"
#include "pipeline/writing.h"
#include "render/raster.h"
#include "stipple/poisson_discs.h"

namespace dstylize {
namespace {

Picture sample() {
    constexpr std::uint64_t kMostBytes = 1u << 26;
    const std::string path = DSTYLIZE_SOURCE_DIR "/samples/portrait.png";
    return PictureCodec().decode(read_file(path, kMostBytes), path).picture;
}

/// A vine stopped between its stages, made once.
struct Vine {
    Picture picture = sample();
    Style style = load_style("vine");
    PreparedPicture base = prepared_picture(picture, style, {});
    Grown grown;
    WeightedLattice graph{Lattice(base.fields.extent(), style.lattice.neighbourhood), {}, {}, true};
    std::vector<Source> sources;
    Drawing drawing = stylize(picture, style, {});

    Vine() {
        grown = grow(base, style, {}, picture.extent(), [&](const StageView& view) { keep(view); }, {});
    }
    void keep(const StageView& view) {
        if (!sources.empty()) return;
        graph = view.graph;
        for (std::uint32_t n = 0; n < view.plan.parent.size(); ++n)
            if (view.plan.owner[n] != Plan::kNoOwner && view.plan.parent[n] == kNoNode)
                sources.push_back({NodeId(n), 0, view.plan.owner[n]});
    }
};
Vine& vine() {
    static Vine once;
    return once;
}

/// With all that the field is made of.
void field(benchmark::State& state, std::string_view name) {
    for (auto _ : state) {
        state.PauseTiming();
        PreparedPicture fresh = prepared_picture(vine().picture, vine().style, {});
        state.ResumeTiming();
        benchmark::DoNotOptimize(fresh.fields[name].data());
    }
}
void flow(benchmark::State& state) {
    for (auto _ : state) {
        state.PauseTiming();
        PreparedPicture fresh = prepared_picture(vine().picture, vine().style, {});
        state.ResumeTiming();
        benchmark::DoNotOptimize(fresh.fields.flow().data());
    }
}

void count_endpoints(benchmark::State& state, std::size_t count) { state.counters["endpoints"] = double(count); }

void endpoints_discs(benchmark::State& state) {
    const Grid<float>& tone = vine().base.fields["tone"];
    std::size_t count = 0;
    for (auto _ : state) {
        Occupancy occupancy(tone.extent());
        const DiscRequest request{.priority = tone, .density = tone, .noise = Noise(1, Purpose::endpoints)};
        count = poisson_discs(request, occupancy).size();
    }
    count_endpoints(state, count);
}
void endpoints_graph_distance(benchmark::State& state) {
    constexpr float kSpacing = 5, kLeast = 0.1f;
    const Grid<float>& importance = vine().base.fields["importance"];
    Grid<float> expense = importance;
    for (float& e : expense) e = kLeast + (1 - kLeast) * e;
    const std::vector<NodeId> start{vine().sources.front().node};
    std::size_t count = 0;
    for (auto _ : state) count = graph_distance_stipples({expense, kSpacing, start, vine().base.passable}, {}).size();
    count_endpoints(state, count);
}

void plan(benchmark::State& state, const Planner& planner, Metric metric) {
    const PlanRequest request{vine().graph, vine().sources, metric};
    for (auto _ : state) benchmark::DoNotOptimize(planner.plan(request, {}).label.size());
    state.counters["Mnodes/s"] =
        benchmark::Counter(double(vine().graph.weight.size()) * 1e-6, benchmark::Counter::kIsIterationInvariantRate);
}

void strokes(benchmark::State& state) {
    const float u = vine().base.fields.u();
    const StrokeParameters& p = vine().style.stroke;
    std::size_t count = 0;
    for (auto _ : state) {
        Dendrite dendrite = vine().grown.dendrite;
        const Branching b = branching(dendrite);
        smooth(dendrite, b, int(p.smooth * u * u));
        count = centrelines(dendrite, b, int(p.junction * u)).size();
    }
    state.counters["strokes"] = double(count);
}
void widths(benchmark::State& state) {
    Fields& fields = vine().base.fields;
    const WidthFields look{&fields["tone"], fields["importance"], &fields["lines"]};
    const Branching b = branching(vine().grown.dendrite);
    for (auto _ : state) {
        const Widths widths(vine().grown.dendrite, b, vine().style.width, look, fields.u());
        benchmark::DoNotOptimize(widths.widths().data());
    }
}

void rastered(benchmark::State& state) {
    const Extent size = vine().picture.extent();
    for (auto _ : state) benchmark::DoNotOptimize(raster(vine().drawing.list, {size}, {}).data());
}
void whole(benchmark::State& state, const std::string& name) {
    const Style style = load_style(name);
    for (auto _ : state) benchmark::DoNotOptimize(stylize(vine().picture, style, {}).strokes);
}

/// Planning and drawing of one letter of about 600 paths in 300 x 300 pixels, without setting it in type.
void letter(benchmark::State& state, const std::string& style_name) {
    constexpr Extent kSize{300, 300};
    Writing words;
    words.lettering.text = "R";
    Controls controls;
    controls.mask = letter_mask(words, kSize);
    const Picture paper(kSize, {255, 255, 255, 255});
    const Style style = load_style(style_name);
    std::size_t strokes = 0;
    for (auto _ : state) {
        const Drawing drawing = stylize(paper, style, controls);
        benchmark::DoNotOptimize(raster(drawing.list, {kSize}, {}).data());
        strokes = drawing.strokes;
    }
    state.counters["strokes"] = double(strokes);
}

void add_all() {
    const auto add = [](const std::string& name, auto... arguments) {
        benchmark::RegisterBenchmark(name.c_str(), arguments...)->Unit(benchmark::kMillisecond)->UseRealTime();
    };
    for (const std::string_view name : Fields::names()) add("field/" + std::string(name), field, name);
    add("field/flow", flow);
    add("endpoints/discs", endpoints_discs);
    add("endpoints/graph-distance", endpoints_graph_distance);
    for (std::size_t m = 0; m < metric_names().size(); ++m) {
        const std::string name(metric_names()[m]);
        add("plan/" + name, [m](auto& state) { plan(state, tile_planner(), Metric(m)); });
        add("plan/bucket/" + name, [m](auto& state) { plan(state, bucket_planner(), Metric(m)); });
        add("plan/reference/" + name, [m](auto& state) { plan(state, reference_planner(), Metric(m)); });
    }
    add("strokes", strokes);
    add("widths", widths);
    add("raster", rastered);
    for (const char* style : {"letters", "lichen-letters"})
        add("letter/" + std::string(style), [style](auto& state) { letter(state, style); });
    for (const BuiltinStyle& style : builtin_styles()) {
        const std::string name(style.name);
        add("whole/" + name, [name](auto& state) { whole(state, name); });
    }
}

}  // namespace
}  // namespace dstylize

int main(int argc, char** argv) {
    dstylize::add_all();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
}
