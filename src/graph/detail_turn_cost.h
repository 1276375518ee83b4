#pragma once
#include <cmath>
#include <cstdint>

#include "core/lattice.h"

namespace dstylize {

/// What an edge costs more for the bend before it: the share (1 - cos) / 2 of `penalty` / 256 times its cost,
/// rounded. 0 at a path's first edge.
class TurnCost {
  public:
    TurnCost(const Lattice& lattice, std::uint32_t penalty) : lattice_(lattice), penalty_(penalty) {}

    std::uint64_t operator()(NodeId before, NodeId at, NodeId next, std::uint64_t cost) const {
        if (penalty_ == 0 || before == kNoNode) return 0;
        const Way in(lattice_, before, at), out(lattice_, at, next);
        const double lengths = std::sqrt(in.squared()) * std::sqrt(out.squared());
        const double bend = lengths > 0 ? (1 - (in.x * out.x + in.y * out.y) / lengths) / 2 : 0;
        constexpr double kUnit = 256;
        return std::uint64_t(std::llround(double(cost) * (penalty_ / kUnit) * bend));
    }

  private:
    /// From node to node, in 1/1024 of a cell: whole numbers, so that products are exact.
    struct Way {
        double x, y;
        Way(const Lattice& lattice, NodeId from, NodeId to) {
            constexpr float kFinely = 1024;
            const Vec2f way = kFinely * (lattice.position_lattice(to) - lattice.position_lattice(from));
            x = double(std::round(way.x)), y = double(std::round(way.y));
        }
        double squared() const { return x * x + y * y; }
    };
    const Lattice& lattice_;
    std::uint32_t penalty_;
};

}  // namespace dstylize
