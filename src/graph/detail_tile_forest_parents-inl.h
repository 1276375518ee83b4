// Parents in a forest, from the steps of its edges and labels at rest.
#if defined(DSTYLIZE_GRAPH_DETAIL_TILE_FOREST_PARENTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef DSTYLIZE_GRAPH_DETAIL_TILE_FOREST_PARENTS_INL_H_
#undef DSTYLIZE_GRAPH_DETAIL_TILE_FOREST_PARENTS_INL_H_
#else
#define DSTYLIZE_GRAPH_DETAIL_TILE_FOREST_PARENTS_INL_H_
#endif

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "graph/detail_forest_walk.h"
#include "graph/detail_tile_parents-inl.h"

HWY_BEFORE_NAMESPACE();
namespace dstylize::HWY_NAMESPACE {

struct ForestRow {
    std::span<const Step> steps;
    const std::uint32_t* sum;   // of the row's first node
    const std::uint8_t* edges;  // bit s: the edge by step s
    int width;
    std::ptrdiff_t from(std::size_t s) const { return -(std::ptrdiff_t{steps[s].dy} * width + steps[s].dx); }
};

inline std::uint8_t forest_parent_of(const ForestRow& r, int column) {
    if (r.sum[column] >= kUnreachedWord) return ParentColumn::kNoStep;
    for (std::size_t s = 0; s < r.steps.size(); ++s)
        if ((r.edges[column] >> (s ^ 1) & 1) != 0 && r.sum[column + r.from(s)] < r.sum[column]) return std::uint8_t(s);
    return ParentColumn::kNoStep;
}

/// `arriving`: steps that begin inside the lattice.
HWY_INLINE void forest_parents_of_stretch(const ForestRow& r, std::span<const std::uint8_t> arriving, int column,
                                          std::uint8_t* out) {
    const Tag<std::uint32_t> d;
    const hn::Rebind<std::uint8_t, decltype(d)> bytes;
    const auto sum = hn::LoadU(d, r.sum + column);
    const auto edges = hn::PromoteTo(d, hn::LoadU(bytes, r.edges + column));
    const auto none = hn::Set(d, std::uint32_t{ParentColumn::kNoStep});
    auto step = none;
    for (const std::uint8_t s : arriving) {
        const auto is_lower = hn::Lt(hn::LoadU(d, r.sum + (column + r.from(s))), sum);
        const auto is_edge = hn::TestBit(edges, hn::Set(d, 1u << (s ^ 1u)));
        step = hn::IfThenElse(hn::And(is_edge, is_lower), hn::Set(d, std::uint32_t{s}), step);
    }
    step = hn::IfThenElse(hn::Lt(sum, hn::Set(d, std::uint32_t{kUnreachedWord})), step, none);
    hn::StoreU(hn::DemoteTo(bytes, hn::BitCast(hn::RebindToSigned<decltype(d)>(), step)), bytes, out + column);
}

inline bool all_reached(const std::uint32_t* sum, int width) {
    std::uint32_t largest = 0;
    for (int i = 0; i < width; ++i) largest = std::max(largest, sum[i]);
    return largest < kUnreachedWord;
}

inline bool find_forest_parents(const Lattice& lattice, const std::uint32_t* sum, int first_row, int end_row,
                                std::uint8_t* step) {
    const int width = lattice.extent().x;
    std::vector<std::uint8_t> edges(static_cast<std::size_t>(width)), arriving;
    bool complete = true;
    for (int j = first_row; j < end_row; ++j) {
        const std::size_t first = std::size_t(j) * std::size_t(width);
        std::copy_n(step + first, width, edges.begin());
        const ForestRow row{lattice.steps(), sum + first, edges.data(), width};
        arriving.clear();
        for (std::size_t s = 0; s < row.steps.size(); ++s)
            if (j - row.steps[s].dy >= 0 && j - row.steps[s].dy < lattice.extent().y)
                arriving.push_back(std::uint8_t(s));
        std::uint8_t* const out = step + first;
        cover_row(
            width, kLanes<std::uint32_t>, [&](int c) { out[c] = forest_parent_of(row, c); },
            [&](int c) { forest_parents_of_stretch(row, arriving, c, out); });
        complete = complete && all_reached(row.sum, width);
    }
    return complete;
}

}  // namespace dstylize::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
