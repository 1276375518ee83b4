#include "core/lattice.h"

#include <algorithm>

namespace dstylize {
namespace {
constexpr std::array<Step, 16> kSteps{{{1, 0, 5},
                                       {-1, 0, 5},
                                       {0, 1, 5},
                                       {0, -1, 5},
                                       {1, 1, 7},
                                       {-1, -1, 7},
                                       {1, -1, 7},
                                       {-1, 1, 7},
                                       {2, 1, 11},
                                       {-2, -1, 11},
                                       {1, 2, 11},
                                       {-1, -2, 11},
                                       {1, -2, 11},
                                       {-1, 2, 11},
                                       {2, -1, 11},
                                       {-2, 1, 11}}};
}  // namespace

std::span<const Step> Lattice::steps() const {
    if (adjacency_) return {};
    const std::span<const Step> all(kSteps);
    switch (neighbourhood_) {
        case Neighbourhood::square4: return all.first(4);
        case Neighbourhood::square8: return all.first(8);
        case Neighbourhood::square16: return all;
    }
    return {};
}

NodeId Lattice::nearest(Vec2f p) const {
    return at(std::clamp(int(std::floor(p.x)), 0, extent_.x - 1), std::clamp(int(std::floor(p.y)), 0, extent_.y - 1));
}

}  // namespace dstylize
