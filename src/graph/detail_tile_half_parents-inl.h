// Parents from halves of labels, twice as many at a time as from whole ones.
#if defined(DSTYLIZE_GRAPH_DETAIL_TILE_HALF_PARENTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef DSTYLIZE_GRAPH_DETAIL_TILE_HALF_PARENTS_INL_H_
#undef DSTYLIZE_GRAPH_DETAIL_TILE_HALF_PARENTS_INL_H_
#else
#define DSTYLIZE_GRAPH_DETAIL_TILE_HALF_PARENTS_INL_H_
#endif

#include <vector>

#include "graph/detail_tile_parents-inl.h"

HWY_BEFORE_NAMESPACE();
namespace dstylize::HWY_NAMESPACE {

// Of the neighbours that give a node its label, with as high an edge before them, the one with the smallest sum is
// the one whose edge costs most.
//
// For `sum` where edges cost the same both ways, the labels of their ends differ by no more than the cost c. If that is
// below 2^15, the low 16 bits of the labels say whether S(u) + c = S(v). Unreached nodes have edges to each other
// alone, and no edge costs 0. Else both halves are looked at.

inline constexpr std::uint32_t kLargestLowCost = 32767, kLargestHalfCost = 65535;

/// The halves of the labels of a row and those within reach.
class HalfRows {
  public:
    HalfRows(int width, bool both)
        : width_(std::size_t(width)), low_(kRows * width_), high_(both ? low_.size() : std::size_t{0}) {}
    void load(const std::uint32_t* label, int row) {
        label += std::size_t(row) * width_;
        std::uint16_t* const low = low_.data() + at(row);
        for (std::size_t i = 0; i < width_; ++i) low[i] = std::uint16_t(label[i]);
        if (high_.empty()) return;
        std::uint16_t* const high = high_.data() + at(row);
        for (std::size_t i = 0; i < width_; ++i) high[i] = std::uint16_t(label[i] >> 16);
    }
    const std::uint16_t* low(int row) const { return low_.data() + at(row); }
    const std::uint16_t* high(int row) const { return high_.data() + at(row); }

  private:
    static constexpr std::size_t kRows = 2 * kReach + 1;
    std::size_t at(int row) const { return std::size_t(row) % kRows * width_; }
    std::size_t width_;
    std::vector<std::uint16_t> low_, high_;
};

template <bool kBottleneck, bool kPlanes, bool kBoth>
void half_parents_of_row(const ParentRow& r, const HalfRows& halves, const StepOrder& order, std::uint8_t* out) {
    const Tag<std::uint16_t> d;
    const hn::Rebind<std::uint8_t, decltype(d)> bytes;
    const Lattice& lattice = r.graph.lattice;
    const std::vector<Arrival> arrivals = arrivals_of_row(r.graph, order, r.row);
    std::vector<const std::uint16_t*> low, high;  // of labels, in the place of the nodes that are arrived at
    for (const Arrival& by : arrivals) {
        const Step step = lattice.steps()[by.step];
        low.push_back(halves.low(r.row - step.dy) - step.dx);
        if (kBoth) high.push_back(halves.high(r.row - step.dy) - step.dx);
    }
    const std::uint16_t* const weight = r.graph.weight.data();
    cover_row(r, order, kLanes<std::uint16_t>, out, [&](int column) {
        const std::ptrdiff_t v = index(lattice.at(column, r.row));
        const auto low_v = hn::LoadU(d, halves.low(r.row) + column);
        auto own = hn::Zero(d), high_v = hn::Zero(d), m_v = hn::Zero(d), best_m = hn::Set(d, std::uint16_t{65535});
        if constexpr (!kPlanes) own = hn::LoadU(d, weight + v);
        if constexpr (kBoth) high_v = hn::LoadU(d, halves.high(r.row) + column);
        if constexpr (kBottleneck) m_v = hn::LoadU(d, r.bottleneck + v);
        auto best_cost = hn::Zero(d), best = hn::Set(d, std::uint16_t{ParentColumn::kNoStep});
        for (std::size_t k = 0; k < arrivals.size(); ++k) {
            const Arrival& by = arrivals[k];
            const auto height = heights_to<kPlanes, std::uint16_t>(weight, v, own, by);
            const auto cost = hn::Mul(height, hn::Set(d, std::uint16_t(by.length5)));
            const auto low_u = hn::LoadU(d, low[k] + column);
            auto better = hn::Eq(hn::Sub(low_v, low_u), cost);
            if constexpr (kBoth) {
                const auto carry = hn::VecFromMask(d, hn::Lt(low_v, low_u));  // -1 where there is one
                better = hn::And(better, hn::Eq(hn::Add(high_v, carry), hn::LoadU(d, high[k] + column)));
            }
            if constexpr (kBottleneck) {
                const auto m_u = hn::LoadU(d, r.bottleneck + (v + by.from));
                better = hn::And(better, hn::Eq(hn::Max(m_u, height), m_v));
                better =
                    hn::And(better, hn::Or(hn::Lt(m_u, best_m), hn::And(hn::Eq(m_u, best_m), hn::Lt(best_cost, cost))));
                best_m = hn::IfThenElse(better, m_u, best_m);
            } else {
                better = hn::And(better, hn::Lt(best_cost, cost));
            }
            best_cost = hn::IfThenElse(better, cost, best_cost);
            best = hn::IfThenElse(better, hn::Set(d, std::uint16_t{by.step}), best);
        }
        hn::StoreU(hn::DemoteTo(bytes, hn::BitCast(hn::RebindToSigned<decltype(d)>(), best)), bytes, out + column);
    });
}

}  // namespace dstylize::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
