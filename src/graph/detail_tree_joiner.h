#pragma once
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace dstylize {

/// What becomes of an edge between two trees.
enum class EdgeFate {
    closes_ring,  ///< not in the forest
    joins,        ///< in the forest
    stays_open,   ///< only who sees what lies outside can tell
};

/// Kruskal's method on a part of a graph. Edges are taken in order, those that leave the part as well: from then on
/// the tree that such an edge leaves is *frozen*, as what lies outside may join it by something less than what is
/// still to come. An edge between two trees of which one is not frozen is the least that leaves that one: it is in
/// the forest. One between two frozen trees stays open; from there on both count as one, as nothing later can be in
/// the forest that closes a ring with it.
template <class Tree>
class TreeJoiner {
  public:
    /// Trees by number: each points to itself or, on the way to its root, to another.
    void begin(std::span<const Tree> root) {
        grown_.assign(root.begin(), root.end());
        join_as_grown();
    }
    void begin(std::vector<Tree>&& root) {
        grown_ = std::move(root);
        join_as_grown();
    }
    void begin(std::size_t trees) {
        grown_.resize(trees);
        std::iota(grown_.begin(), grown_.end(), Tree{0});
        join_as_grown();
    }

    /// Trees that count as one though no edge joins them.
    void unite(Tree a, Tree b) {
        joined_[root_of(joined_, b)] = root_of(joined_, a);
        grown_[root_of(grown_, b)] = root_of(grown_, a);
    }
    void freeze(Tree t) { is_frozen_[root_of(joined_, t)] = true; }

    EdgeFate take(Tree u, Tree v) {
        const Tree a = root_of(joined_, u), b = root_of(joined_, v);
        if (a == b) return EdgeFate::closes_ring;
        joined_[b] = a;
        if (is_frozen_[a] && is_frozen_[b]) return EdgeFate::stays_open;
        is_frozen_[a] = is_frozen_[a] || is_frozen_[b];
        grown_[root_of(grown_, v)] = root_of(grown_, u);
        return EdgeFate::joins;
    }

    /// The same for all of a tree that edges of the forest have joined.
    Tree root(Tree t) { return root_of(grown_, t); }

  private:
    void join_as_grown() {
        joined_ = grown_;
        is_frozen_.assign(grown_.size(), false);
    }

    /// Ways to a root are halved by the way.
    static Tree root_of(std::vector<Tree>& parent, Tree n) {
        while (parent[n] != n) n = parent[n] = parent[parent[n]];
        return n;
    }
    std::vector<Tree> joined_;             // by edges that are in the forest or open
    std::vector<Tree> grown_;              // by those that are in the forest
    std::vector<std::uint8_t> is_frozen_;  // of the roots in joined_
};

}  // namespace dstylize
