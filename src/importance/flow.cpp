// Which way the picture runs: a sum of structure tensors, each divided by its own trace so that faint
// structures steer as well as strong ones, plus curls where the picture says nothing.
#include <algorithm>
#include <cmath>

#include "imaging/filters.h"
#include "importance/detail_field_functions.h"

namespace dstylize::field {
namespace {

/// sum += weight * (t blurred) / max(its trace, the trace's given percentile).
void add_normalised(StructureTensor& sum, const StructureTensor& t, float sigma, float weight, float trace_percent) {
    const Grid<float> xx = blurred(t.xx, sigma), xy = blurred(t.xy, sigma), yy = blurred(t.yy, sigma);
    Grid<float> trace = xx;
    each_index(trace.size(), [&](std::size_t n) { trace[n] += yy[n]; });
    const float least = percentile(trace, trace_percent) + 1e-9f;
    each_index(trace.size(), [&](std::size_t n) {
        const float k = weight / std::max(trace[n], least);
        sum.xx[n] += k * xx[n];
        sum.xy[n] += k * xy[n];
        sum.yy[n] += k * yy[n];
    });
}

}  // namespace

FlowField flow(Fields& fields) {
    constexpr float kSwirlScale_u = 60;
    const FieldParameters& p = fields.parameters();
    const float u = fields.u();
    const Grid<float> zero(fields.extent());
    StructureTensor sum{zero, zero, zero};
    const StructureTensor t = structure_tensor(derivatives(blurred(fields["lightness"], 1.5f * u)));
    add_normalised(sum, t, p.flow_fine * u, 1, 60);
    add_normalised(sum, t, p.flow_coarse * u, p.flow_coarse_share, 30);
    if (p.flow_swirl > 0) {
        const Grid<float> hills = correlated_noise(fields, Purpose::swirl, kSwirlScale_u / 4, kSwirlScale_u);
        add_normalised(sum, structure_tensor(derivatives(hills)), 2 * u, p.flow_swirl, 5);
    }
    FlowField out(fields.extent());
    each_index(out.size(), [&](std::size_t n) {
        const float difference = sum.xx[n] - sum.yy[n], cross = 2 * sum.xy[n];
        const float coherence = std::min(1.0f, std::sqrt(difference * difference + cross * cross));
        const float across = 0.5f * std::atan2(cross, difference);  // direction of the gradient
        out[n] = Vec2f{-std::sin(across), std::cos(across)} * coherence;
    });
    return out;
}

}  // namespace dstylize::field
