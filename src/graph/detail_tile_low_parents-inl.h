// Parents from the low halves of labels, twice as many at a time: for `sum` where edges cost the same both ways.
#if defined(DSTYLIZE_GRAPH_DETAIL_TILE_LOW_PARENTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef DSTYLIZE_GRAPH_DETAIL_TILE_LOW_PARENTS_INL_H_
#undef DSTYLIZE_GRAPH_DETAIL_TILE_LOW_PARENTS_INL_H_
#else
#define DSTYLIZE_GRAPH_DETAIL_TILE_LOW_PARENTS_INL_H_
#endif

#include <vector>

#include "graph/detail_tile_parents-inl.h"

HWY_BEFORE_NAMESPACE();
namespace dstylize::HWY_NAMESPACE {

// Where edges cost the same both ways, the labels of their ends differ by no more than the cost c. If that is
// below 2^15, the low 16 bits of the labels say whether S(u) + c = S(v), and the smallest S(u) belongs to the
// largest c. Unreached nodes have edges to each other alone, and no edge costs 0.

inline constexpr std::uint32_t kLargestLowCost = 32767;

/// The low halves of the labels of a row and those within reach.
class LowRows {
  public:
    explicit LowRows(int width) : width_(std::size_t(width)), low_(kRows * width_) {}
    void load(const std::uint32_t* label, int row) {
        std::uint16_t* const low = low_.data() + at(row);
        for (std::size_t i = 0; i < width_; ++i) low[i] = std::uint16_t(label[std::size_t(row) * width_ + i]);
    }
    const std::uint16_t* operator[](int row) const { return low_.data() + at(row); }

  private:
    static constexpr std::size_t kRows = 2 * kReach + 1;
    std::size_t at(int row) const { return std::size_t(row) % kRows * width_; }
    std::size_t width_;
    std::vector<std::uint16_t> low_;
};

template <bool kPlanes>
void low_parents_of_row(const ParentRow& r, const LowRows& low, const StepOrder& order, std::uint8_t* out) {
    const Tag<std::uint16_t> d;
    const hn::Rebind<std::uint8_t, decltype(d)> bytes;
    const Lattice& lattice = r.graph.lattice;
    const std::vector<Arrival> arrivals = arrivals_of_row(r.graph, order, r.row);
    std::vector<const std::uint16_t*> from;  // labels, in the place of the nodes that are arrived at
    for (const Arrival& by : arrivals) {
        const Step step = lattice.steps()[by.step];
        from.push_back(low[r.row - step.dy] - step.dx);
    }
    const std::uint16_t *const weight = r.graph.weight.data(), *const here = low[r.row];
    cover_row(r, order, kLanes<std::uint16_t>, out, [&](int column) {
        const std::ptrdiff_t v = index(lattice.at(column, r.row));
        const auto own = hn::LoadU(d, weight + v), label = hn::LoadU(d, here + column);
        auto best_cost = hn::Zero(d), best = hn::Set(d, std::uint16_t{ParentColumn::kNoStep});
        for (std::size_t k = 0; k < arrivals.size(); ++k) {
            const Arrival& by = arrivals[k];
            const auto cost =
                hn::Mul(heights_to<kPlanes, std::uint16_t>(weight, v, own, by), hn::Set(d, std::uint16_t(by.length5)));
            const auto risen = hn::Sub(label, hn::LoadU(d, from[k] + column));
            const auto better = hn::And(hn::Eq(risen, cost), hn::Lt(best_cost, cost));
            best_cost = hn::IfThenElse(better, cost, best_cost);
            best = hn::IfThenElse(better, hn::Set(d, std::uint16_t{by.step}), best);
        }
        hn::StoreU(hn::DemoteTo(bytes, hn::BitCast(hn::RebindToSigned<decltype(d)>(), best)), bytes, out + column);
    });
}

}  // namespace dstylize::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
