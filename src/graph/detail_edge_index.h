#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "core/lattice.h"

namespace dstylize {

// An edge's index, whichever way it is walked: its smaller node and the rank of the larger one among those that
// edges lead to from there. Indices are ordered as (smaller node, larger node) is, and fit into 40 bits.

/// On a regular lattice of so many steps.
template <int kSteps>
class StepEdgeIndex {
  public:
    explicit StepEdgeIndex(const Lattice& lattice) {
        const auto steps = lattice.steps();
        const auto before = [](Step a, Step b) { return a.dy != b.dy ? a.dy < b.dy : a.dx < b.dx; };
        const auto is_forward = [&](Step s) { return before({0, 0, 0}, s); };
        for (std::size_t s = 0; s < kSteps; ++s) {
            backward_[s] = !is_forward(steps[s]);
            const Step forward = backward_[s] ? steps[s ^ 1] : steps[s];
            for (const Step other : steps) rank_[s] += is_forward(other) && before(other, forward);
            forward_[rank_[s]] = {std::uint32_t(forward.dy * lattice.extent().x + forward.dx), forward.length5};
        }
    }
    std::uint64_t of(std::uint32_t from, std::uint32_t to, int step) const {
        return std::uint64_t(backward_[std::size_t(step)] ? to : from) * kRanks + rank_[std::size_t(step)];
    }
    std::uint32_t smaller_node(std::uint64_t edge) const { return std::uint32_t(edge / kRanks); }
    std::uint32_t larger_node(std::uint64_t edge) const { return smaller_node(edge) + forward_[edge % kRanks].offset; }
    std::uint32_t length5(std::uint64_t edge) const { return forward_[edge % kRanks].length5; }

  private:
    static constexpr std::uint32_t kRanks = 8;  // at least kSteps / 2
    struct Forward {
        std::uint32_t offset = 0;  // towards the larger node index
        std::uint32_t length5 = 0;
    };
    std::array<bool, kSteps> backward_{};
    std::array<std::uint32_t, kSteps> rank_{};
    std::array<Forward, kRanks> forward_{};
};

/// On an irregular lattice; takes a byte for each of its edges.
class ListedEdgeIndex {
  public:
    explicit ListedEdgeIndex(const Lattice& lattice)
        : adjacency_(*lattice.adjacency()), rank_(adjacency_.to.size()), has_all_(find_ranks()) {}
    /// False where some edge has no like back, as long, or a list is out of order, or a node has very many edges.
    bool has_all() const { return has_all_; }
    std::uint64_t of(std::uint32_t from, std::uint32_t to, int edge) const {
        return std::uint64_t(std::min(from, to)) * kRanks + rank_[std::size_t(edge)];
    }
    std::uint32_t smaller_node(std::uint64_t edge) const { return std::uint32_t(edge / kRanks); }
    std::uint32_t larger_node(std::uint64_t edge) const { return adjacency_.to[place(edge)]; }
    std::uint32_t length5(std::uint64_t edge) const { return adjacency_.length5[place(edge)]; }

  private:
    static constexpr std::uint32_t kRanks = 256;
    std::size_t place(std::uint64_t edge) const { return adjacency_.first[edge / kRanks] + edge % kRanks; }

    bool find_ranks() {
        const auto& [position, first, to, length5] = adjacency_;
        // Nodes are met in their order, so each finds itself next in the list of a larger one.
        std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
        for (std::uint32_t u = 0; u < next.size(); ++u)
            for (std::uint32_t e = first[u]; e < first[u + 1]; ++e) {
                const std::uint32_t v = to[e], rank = e - first[u];
                if (v < u) continue;
                const std::uint32_t back = next[v]++;
                const bool leads_back = v != u && back < first[v + 1] && to[back] == u && length5[back] == length5[e];
                if (!leads_back || rank >= kRanks || (rank > 0 && to[e - 1] > v)) return false;
                rank_[e] = rank_[back] = std::uint8_t(rank);
            }
        // No edge to a smaller node is left over.
        for (std::uint32_t u = 0; u < next.size(); ++u)
            if (next[u] < first[u + 1] && to[next[u]] < u) return false;
        return true;
    }

    const Adjacency& adjacency_;
    std::vector<std::uint8_t> rank_;  // of the larger node, from the smaller one
    bool has_all_;
};

}  // namespace dstylize
