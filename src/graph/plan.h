#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/grid.h"
#include "core/lattice.h"

namespace dstylize {

/// What it costs to reach a node by its tree path, or kUnreached in `sum`. For `lexicographic` the sum
/// describes that path, but it is not by it that paths were compared.
struct PathLabel {
    static constexpr std::uint64_t kUnreached = std::numeric_limits<std::uint64_t>::max();
    std::uint32_t highest = 0;       ///< highest edge of the path, where the metric compares it alone; else 0
    std::uint64_t sum = kUnreached;  ///< start label of its source + sum of the edge costs
    friend bool operator==(const PathLabel&, const PathLabel&) = default;
};

// A plan has three columns with an entry per node. Pictures have millions of nodes, so that what a
// column takes decides how long it takes to fill: each has a narrow form for what is usual and a wide
// one for anything. Both read the same.

/// Labels: 4 bytes where sums fit and nothing has a highest edge, 6 where something has and it fits; else 16.
class LabelColumn {
  public:
    static constexpr std::uint32_t kUnreached32 = std::numeric_limits<std::uint32_t>::max();
    LabelColumn() = default;
    LabelColumn(std::vector<PathLabel> labels) : wide_(std::move(labels)) {}
    /// Sums below kUnreached32, which stands for "unreached"; `highest` is empty where all are 0.
    LabelColumn(UnsetVector<std::uint32_t> sum, UnsetVector<std::uint16_t> highest)
        : sum_(std::move(sum)), highest_(std::move(highest)) {}

    std::size_t size() const { return wide_.size() + sum_.size(); }
    PathLabel operator[](std::size_t n) const {
        if (sum_.empty()) return wide_[n];
        if (sum_[n] == kUnreached32) return {};
        return {highest_.empty() ? 0u : highest_[n], sum_[n]};
    }
    /// The sums and the highest edges, where these are narrow.
    std::span<const std::uint32_t> sums() const { return sum_; }
    std::span<const std::uint16_t> highest() const { return highest_; }
    friend bool operator==(const LabelColumn& a, const LabelColumn& b);

  private:
    std::vector<PathLabel> wide_;
    UnsetVector<std::uint32_t> sum_;
    UnsetVector<std::uint16_t> highest_;
};

/// Parents: 1 byte on a regular lattice, the number of the step that leads from the parent to the node.
class ParentColumn {
  public:
    static constexpr std::uint8_t kNoStep = 255;
    ParentColumn() = default;
    ParentColumn(std::vector<NodeId> parents) : wide_(std::move(parents)) {}
    /// `step`: indices into lattice.steps(), or kNoStep.
    ParentColumn(const Lattice& lattice, UnsetVector<std::uint8_t> step);

    std::size_t size() const { return wide_.size() + step_.size(); }
    NodeId operator[](std::size_t n) const {
        if (step_.empty()) return wide_[n];
        return step_[n] == kNoStep ? kNoNode : NodeId{std::uint32_t(n) - offset_[step_[n]]};
    }
    /// The steps; none where the column is wide.
    std::span<const std::uint8_t> steps() const { return step_; }
    friend bool operator==(const ParentColumn& a, const ParentColumn& b);

  private:
    std::vector<NodeId> wide_;
    UnsetVector<std::uint8_t> step_;
    std::array<std::uint32_t, 16> offset_{};  // from a node to the one that a step leads to, modulo 2^32
};

/// Owners: 1 byte, an index into those that there are, unless they are more than 255.
class OwnerColumn {
  public:
    OwnerColumn() = default;
    OwnerColumn(std::vector<std::uint16_t> owners) : wide_(std::move(owners)) {}
    OwnerColumn(std::vector<std::uint16_t> palette, UnsetVector<std::uint8_t> entry)
        : palette_(std::move(palette)), entry_(std::move(entry)) {}

    std::size_t size() const { return wide_.size() + entry_.size(); }
    std::uint16_t operator[](std::size_t n) const { return entry_.empty() ? wide_[n] : palette_[entry_[n]]; }
    friend bool operator==(const OwnerColumn& a, const OwnerColumn& b);

  private:
    std::vector<std::uint16_t> wide_, palette_;
    UnsetVector<std::uint8_t> entry_;
};

/// The answer for every node: one, whatever the implementation, thread count or order of work.
/// A node's parent is, among the neighbours that give it its label, the one with the smallest label,
/// then the smallest index; for `lexicographic` the neighbour in the minimum spanning forest under the
/// order (height, smaller node index, larger node index) of edges. Its owner is its parent's owner.
struct Plan {
    static constexpr std::uint16_t kNoOwner = 0xffff;
    LabelColumn label;
    ParentColumn parent;  ///< kNoNode at sources and at unreached nodes
    OwnerColumn owner;    ///< kNoOwner where no path exists
};

}  // namespace dstylize
