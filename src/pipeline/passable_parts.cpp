// Connected parts of the passable nodes: on a regular lattice run by run, else node by node.
#include <algorithm>
#include <numeric>

#include "imaging/bands.h"
#include "pipeline/roots.h"

namespace dstylize {
namespace {

constexpr std::size_t kRowsAtOnce = 64;

/// Passable nodes side by side in a row.
struct RowRun {
    int row, first, last;
};

std::vector<RowRun> runs_of(const WeightedLattice& graph) {
    const Extent e = graph.lattice.extent();
    std::vector<RowRun> runs;
    for (int j = 0; j < e.y; ++j) {
        const NodeWeight* const weight = graph.weight.data() + std::size_t(j) * std::size_t(e.x);
        for (int i = 0; i < e.x; ++i) {
            if (weight[i] == kImpassable) continue;
            const int first = i;
            while (i < e.x && weight[i] != kImpassable) ++i;
            runs.push_back({j, first, i - 1});
        }
    }
    return runs;
}

/// Sets of runs; a set's root is its first run.
class RunSets {
  public:
    explicit RunSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
    std::uint32_t root(std::uint32_t run) {
        while (parent_[run] != run) run = parent_[run] = parent_[parent_[run]];
        return run;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = root(a);
        b = root(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<std::uint32_t> parent_;
};

/// Joins each run to those of the row above that it touches; `slant` 1 where steps go diagonally.
void join_rows(const std::vector<RowRun>& runs, int slant, RunSets& sets) {
    std::uint32_t above = 0;
    for (std::uint32_t r = 0; r < runs.size(); ++r) {
        const RowRun& run = runs[r];
        while (runs[above].row < run.row - 1 ||
               (runs[above].row == run.row - 1 && runs[above].last < run.first - slant))
            ++above;
        for (std::uint32_t a = above; runs[a].row == run.row - 1 && runs[a].first <= run.last + slant; ++a)
            sets.join(a, r);
    }
}

PassableParts parts_by_runs(const WeightedLattice& graph) {
    PassableParts out{Grid<std::uint32_t>::unset(graph.lattice.extent()), {}, {}};
    const std::vector<RowRun> runs = runs_of(graph);
    RunSets sets(runs.size());
    // A knight's move never joins what the other steps do not.
    join_rows(runs, graph.lattice.steps().size() > 4 ? 1 : 0, sets);
    std::vector<std::uint32_t> part(runs.size());
    for (std::uint32_t r = 0; r < runs.size(); ++r) {
        const RowRun& run = runs[r];
        const std::uint32_t root = sets.root(r);
        if (root == r) {
            part[r] = std::uint32_t(out.size.size());
            out.size.push_back(0);
            out.box.emplace_back();
        }
        part[r] = part[root];
        out.box[part[r]].add(run.first, run.last, run.row);
        out.size[part[r]] += std::uint32_t(run.last - run.first + 1);
    }
    const auto fill_row = [&](std::size_t j) {
        std::uint32_t* const row = out.part.row(int(j));
        std::fill_n(row, graph.lattice.extent().x, PassableParts::kNone);
        const auto before = [](const RowRun& run, int of_row) { return run.row < of_row; };
        for (auto run = std::lower_bound(runs.begin(), runs.end(), int(j), before);
             run != runs.end() && run->row == int(j); ++run)
            std::fill(row + run->first, row + run->last + 1, part[std::size_t(run - runs.begin())]);
    };
    each_index(std::size_t(graph.lattice.extent().y), fill_row, kRowsAtOnce);
    return out;
}

PassableParts parts_by_flood(const WeightedLattice& graph, const Adjacency& listed) {
    PassableParts out{Grid<std::uint32_t>(graph.lattice.extent(), PassableParts::kNone), {}, {}};
    std::vector<NodeId> open;
    const auto reach = [&](NodeId next, std::uint32_t part) {
        if (!graph.passable(next) || out.part[index(next)] != PassableParts::kNone) return;
        out.part[index(next)] = part;
        open.push_back(next);
    };
    for (std::uint32_t n = 0; n < graph.lattice.node_count(); ++n) {
        const auto part = std::uint32_t(out.size.size());
        reach(NodeId{n}, part);
        if (open.empty()) continue;
        out.size.push_back(0);
        out.box.emplace_back();
        while (!open.empty()) {
            const NodeId node = open.back();
            open.pop_back();
            ++out.size[part];
            out.box[part].add(graph.lattice.column(node), graph.lattice.column(node), graph.lattice.row(node));
            for (std::uint32_t edge = listed.first[index(node)]; edge < listed.first[index(node) + 1]; ++edge)
                reach(NodeId{listed.to[edge]}, part);
        }
    }
    return out;
}

}  // namespace

PassableParts passable_parts(const WeightedLattice& graph) {
    const Adjacency* const listed = graph.lattice.adjacency();
    return listed ? parts_by_flood(graph, *listed) : parts_by_runs(graph);
}

}  // namespace dstylize
