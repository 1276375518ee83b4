#include "render/detail_prepare.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "render/detail_capsule.h"

namespace dstylize {
namespace {

constexpr int kTileSamples = 128;
/// Two as the least: where two strokes meet, `max` keeps only the larger of their shares of a sample, which a
/// whole pixel would show. Three across the mean stroke: gaps between strokes are about as wide as they.
constexpr double kLeastSamplesPerPixel = 2, kSamplesPerWidth = 3;
constexpr double kMostSamples = 128e6;
/// A run may hold this many segments that miss the tile before a new run is cheaper.
constexpr std::uint32_t kRunGap = 8;

struct Scale {
    float x, y, width;
};

double mean_stroke_width(std::span<const Layer> layers) {
    double area = 0, total = 0;
    for (const Layer& layer : layers)
        for (const Item& item : layer.items)
            if (const auto* stroke = std::get_if<VariableStroke>(&item))
                for (std::size_t i = 0; i + 1 < stroke->points_px.size(); ++i) {
                    const double run = distance(stroke->points_px[i], stroke->points_px[i + 1]);
                    area += run * 0.5 * (stroke->width_px[i] + stroke->width_px[i + 1]);
                    total += run;
                }
    return total > 0 ? area / total : 0;
}

int samples_per_pixel(std::span<const Layer> layers, const RasterOptions& options, double scale) {
    const double width = mean_stroke_width(layers) * scale;
    int wanted = int(kLeastSamplesPerPixel);
    if (width > 0)
        wanted = int(std::clamp(std::ceil(kSamplesPerWidth / width), kLeastSamplesPerPixel,
                                double(options.most_samples_per_pixel)));
    while (wanted > kLeastSamplesPerPixel && double(options.size_px.count()) * wanted * wanted > kMostSamples) --wanted;
    return wanted;
}

/// The emission at the points of `line`, which runs along `points` more finely or more coarsely: both are
/// compared by the share of their length.
std::vector<float> emission_along(const TaperedLine& line, std::span<const Vec2f> points,
                                  std::span<const float> emission) {
    std::vector<float> arc(points.size(), 0.0f), out;
    for (std::size_t i = 1; i < points.size(); ++i) arc[i] = arc[i - 1] + distance(points[i - 1], points[i]);
    float total = 0;
    for (std::size_t i = 1; i < line.size(); ++i) total += distance(line[i - 1].at, line[i].at);
    const float stretch = total > 0 ? arc.back() / total : 0;
    float at = 0;
    std::size_t k = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (i > 0) at += distance(line[i - 1].at, line[i].at) * stretch;
        while (k + 2 < points.size() && arc[k + 1] < at) ++k;
        const std::size_t next = std::min(k + 1, points.size() - 1);
        const float run = arc[next] - arc[k], t = run > 0 ? std::clamp((at - arc[k]) / run, 0.0f, 1.0f) : 0;
        out.push_back(emission[k] + (emission[next] - emission[k]) * t);
    }
    return out;
}

PreparedItem prepared_item(const Item& item, Scale scale, float flatness) {
    PreparedItem out;
    auto scaled = [&](Vec2f p) { return Vec2f{p.x * scale.x, p.y * scale.y}; };
    if (const auto* fill = std::get_if<Fill>(&item)) {
        for (Vec2f p : fill->outline_px) out.outline.push_back(scaled(p));
        return out;
    }
    const auto& stroke = std::get<VariableStroke>(item);
    std::vector<Vec2f> points;
    std::vector<float> widths;
    points.reserve(stroke.points_px.size());
    widths.reserve(stroke.points_px.size());
    for (std::size_t i = 0; i < stroke.points_px.size(); ++i) {
        points.push_back(scaled(stroke.points_px[i]));
        widths.push_back(stroke.width_px[i] * scale.width);
    }
    out.line = simplified(smooth_line(points, widths, flatness), flatness);
    straighten_thin_ends(out.line);
    if (!stroke.emission.empty()) out.emission = emission_along(out.line, points, stroke.emission);
    return out;
}

void assign_layers_and_colours(std::span<const Layer> layers, Prepared& out) {
    std::map<std::array<float, 4>, std::uint32_t> known;
    std::size_t i = 0;
    for (std::size_t l = 0; l < layers.size(); ++l)
        for (const Item& item : layers[l].items) {
            const Rgba c = std::visit([](const auto& it) { return it.colour; }, item);
            const auto [entry, is_new] = known.try_emplace({c.r, c.g, c.b, c.a}, std::uint32_t(out.palette.size()));
            if (is_new) out.palette.push_back(c);
            out.items[i].layer = std::uint32_t(l);
            out.items[i++].colour = entry->second;
        }
}

/// Collects the runs of each tile, item after item.
class Binner {
  public:
    explicit Binner(Prepared& target)
        : target_(target), tile_samples_(float(target.tile_px * target.samples_per_pixel)) {
        target_.runs.resize(target_.tiles.count());
    }

    void add(std::uint32_t item) {
        const PreparedItem& it = target_.items[item];
        if (target_.palette[it.colour].a <= 0) return;
        if (!it.outline.empty()) {
            Vec2f lo = it.outline[0], hi = lo;
            for (Vec2f p : it.outline) {
                lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)};
                hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
            }
            add_box(lo, hi, {item, 0, 0});
        }
        const std::size_t segments = std::max<std::size_t>(it.line.size(), 2) - 1;
        for (std::size_t i = 0; i < segments && !it.line.empty(); ++i) {
            const WidthPoint &a = it.line[i], &b = it.line[std::min(i + 1, it.line.size() - 1)];
            const float reach = 0.5f * std::max(a.width, b.width) + 1;
            if (a.width <= 0 && b.width <= 0) continue;
            add_box({std::min(a.at.x, b.at.x) - reach, std::min(a.at.y, b.at.y) - reach},
                    {std::max(a.at.x, b.at.x) + reach, std::max(a.at.y, b.at.y) + reach},
                    {item, std::uint32_t(i), std::uint32_t(i)});
        }
    }

  private:
    void add_box(Vec2f lo, Vec2f hi, Run run) {
        const int x0 = tile(lo.x, target_.tiles.x), x1 = tile(hi.x, target_.tiles.x);
        const int y0 = tile(lo.y, target_.tiles.y), y1 = tile(hi.y, target_.tiles.y);
        for (int y = std::max(y0, 0); y <= std::min(y1, target_.tiles.y - 1); ++y)
            for (int x = std::max(x0, 0); x <= std::min(x1, target_.tiles.x - 1); ++x)
                extend(target_.runs[std::size_t(y) * std::size_t(target_.tiles.x) + std::size_t(x)], run);
    }
    /// Tile index of a coordinate; -1 before the first, `count` after the last.
    int tile(float at, int count) const { return int(std::clamp(std::floor(at / tile_samples_), -1.0f, float(count))); }
    static void extend(std::vector<Run>& runs, Run run) {
        if (!runs.empty() && runs.back().item == run.item && run.first <= runs.back().last + kRunGap)
            runs.back().last = run.last;
        else
            runs.push_back(run);
    }

    Prepared& target_;
    float tile_samples_;
};

}  // namespace

Prepared prepared(const DisplayList& list, std::span<const Layer> layers, const RasterOptions& options,
                  const Work& work) {
    const Extent size_px = options.size_px;
    const double scale_x = size_px.x / double(list.width_px), scale_y = size_px.y / double(list.height_px);
    const double scale_width = std::sqrt(scale_x * scale_y);
    Prepared out;
    out.samples_per_pixel = samples_per_pixel(layers, options, scale_width);
    out.tile_px = kTileSamples / out.samples_per_pixel;
    out.tiles = {(size_px.x + out.tile_px - 1) / out.tile_px, (size_px.y + out.tile_px - 1) / out.tile_px};
    const Scale scale{float(scale_x * out.samples_per_pixel), float(scale_y * out.samples_per_pixel),
                      float(scale_width * out.samples_per_pixel)};

    std::vector<const Item*> sources;
    for (const Layer& layer : layers)
        for (const Item& item : layer.items) sources.push_back(&item);
    out.items.resize(sources.size());
    tbb::parallel_for(std::size_t(0), sources.size(), [&](std::size_t i) {
        out.items[i] = prepared_item(*sources[i], scale, options.flatness_samples);
    });
    work.check();
    assign_layers_and_colours(layers, out);
    Binner binner(out);
    for (std::size_t i = 0; i < out.items.size(); ++i) binner.add(std::uint32_t(i));
    return out;
}

}  // namespace dstylize
