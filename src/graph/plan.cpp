#include "graph/plan.h"

namespace dstylize {
namespace {

template <class Column>
bool same_entries(const Column& a, const Column& b) {
    if (a.size() != b.size()) return false;
    for (std::size_t n = 0; n < a.size(); ++n)
        if (!(a[n] == b[n])) return false;
    return true;
}

}  // namespace

ParentColumn::ParentColumn(const Lattice& lattice, UnsetVector<std::uint8_t> step) : step_(std::move(step)) {
    const auto steps = lattice.steps();
    for (std::size_t s = 0; s < steps.size(); ++s)
        offset_[s] = std::uint32_t(steps[s].dy * lattice.extent().x + steps[s].dx);
}

bool operator==(const LabelColumn& a, const LabelColumn& b) { return same_entries(a, b); }
bool operator==(const ParentColumn& a, const ParentColumn& b) { return same_entries(a, b); }
bool operator==(const OwnerColumn& a, const OwnerColumn& b) { return same_entries(a, b); }

}  // namespace dstylize
