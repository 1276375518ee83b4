// `sum` on irregular lattices. Best-first search over all of a large lattice finds nothing in cache: its frontier is
// long, and every node has edges in five rows. So it searches tile by tile: a visit settles whatever follows from the
// labels of a tile that fell since its last visit, as far as the tile reaches; labels that fall beyond it wait for
// visits to its neighbours, and the tile whose least waiting label is the smallest comes next. As for the passes over
// vectors (tile_planner.cpp), it is exact whatever the order, as labels only fall and edges are relaxed again after.
//
// Parents as well: once a node has its last label, all those that give it this label have theirs or will be settled
// again, and the first of them by (label, index) stays.
#include <algorithm>
#include <atomic>
#include <bit>
#include <memory>
#include <mutex>

#include "graph/detail_edge_range.h"
#include "graph/detail_heights.h"
#include "graph/detail_listed_search.h"
#include "graph/detail_owners.h"
#include "graph/detail_radix_queue.h"
#include "graph/detail_sources.h"
#include "graph/detail_tile_queue.h"
#include "graph/detail_workers.h"

namespace dstylize {
namespace {

/// Where a node lies, seen from a tile.
struct Place {
    std::size_t beside;  // of the nine tiles around and including it, row by row; 4 is the tile itself
    std::size_t own;     // its number among the tile's own nodes
    bool is_near;
};
constexpr std::size_t kSelf = 4;

template <class Edges>
class ListedSearch {
  public:
    ListedSearch(const PlanRequest& request, const std::vector<Source>& sources, const Work& work)
        : lattice_(request.graph.lattice),
          edges_(request.graph),
          tiling_(lattice_),
          bucket_bits_(int(std::bit_width(edge_range(request.graph).least_cost)) - 1),
          sources_(sources),
          work_(work),
          label_(lattice_.node_count(), kUnreached),
          parent_(lattice_.node_count(), kNoNode),
          fallen_(std::size_t(tiling_.count())) {
        const Plan* const earlier = reusable_plan(request, sources);
        if (earlier == nullptr || earlier->label.sums().size() != label_.size()) return;
        std::copy_n(earlier->label.sums().begin(), label_.size(), label_.begin());
        for (std::size_t n = 0; n < parent_.size(); ++n) parent_[n] = earlier->parent[n];
    }

    std::optional<Plan> run(TileStats& stats) && {
        const int workers = std::min(thread_count(work_), tiling_.count());
        TileQueue queue(tiling_, workers, kLead);
        for (const Source& s : sources_) {
            if (s.start >= kUnreached) return {};
            const int tile = tiling_.tile_of(lattice_.column(s.node), lattice_.row(s.node));
            const std::uint32_t start = std::uint32_t(s.start), before = label_[index(s.node)];
            if (start > before) continue;
            parent_[index(s.node)] = kNoNode;
            if (start == before) continue;
            label_[index(s.node)] = start;
            fallen_[std::size_t(tile)].push_back(index(s.node));
            Pending pending;
            pending.add(start, start, 1, 1);
            queue.add(tile, pending);
        }
        std::atomic<std::uint64_t> visits{0};
        run_workers(workers, [&](int worker) {
            const auto scratch = std::make_unique<Scratch>();
            while (auto visit = queue.take(worker)) {
                settle_tile(*scratch, *visit);
                ++visits;
                if (!fits_ || work_.stop.stop_requested()) queue.abandon();
                queue.finish(*visit);
            }
        });
        work_.check();
        if (!fits_) return {};
        stats.tiles = std::uint64_t(tiling_.count());
        stats.visits = visits;
        ParentColumn parent(std::move(parent_));
        OwnerColumn owner = owners_by_parents(parent, sources_, work_);
        return Plan{{std::move(label_), {}}, std::move(parent), std::move(owner)};
    }

  private:
    static constexpr std::uint32_t kUnreached = LabelColumn::kUnreached32;
    /// As for passes over vectors: so much more urgent another worker's tile has to be.
    static constexpr std::uint32_t kLead = 65536;

    /// Memory of one thread.
    struct Scratch {
        RadixQueue queue;
        std::vector<RadixQueue::Entry> least;
        std::vector<std::uint32_t> settled;  // the label with which each of the tile's own nodes was settled last
        std::array<std::vector<std::uint32_t>, 9> fallen;
    };

    std::uint64_t bucket(std::uint32_t label) const { return label >> bucket_bits_; }

    Place place(std::uint32_t node, Offset first) const {
        constexpr int kReach = 16;
        const int side = tiling_.side(), width = lattice_.extent().x;
        const int x = int(node) % width - first.dx, y = int(node) / width - first.dy;
        const std::size_t column = std::size_t(1 + (x >= side) - (x < 0)), row = std::size_t(1 + (y >= side) - (y < 0));
        return {3 * row + column, std::size_t(y * side + x),
                x >= -kReach && y >= -kReach && x < side + kReach && y < side + kReach};
    }

    void settle_tile(Scratch& s, TileVisit& visit) {
        const Offset origin = tiling_.origin(visit.tile);
        const Offset first{origin.dx + tiling_.rim(), origin.dy + tiling_.rim()};
        take_fallen(s, visit.tile);
        s.settled.assign(std::size_t(tiling_.side() * tiling_.side()), kUnreached);
        const auto is_stale = [this](const RadixQueue::Entry& e) { return bucket(label_[e.node]) != e.priority; };
        while (s.queue.take_least(s.least, is_stale)) {
            for (const RadixQueue::Entry& e : s.least) {
                std::uint32_t& settled = s.settled[place(e.node, first).own];
                if (is_stale(e) || settled == label_[e.node]) continue;
                settled = label_[e.node];
                settle(s, visit, e.node, first);
            }
        }
        s.queue.restart();
        give_fallen(s, visit.tile);
    }

    void settle(Scratch& s, TileVisit& visit, std::uint32_t u, Offset first) {
        const std::uint64_t label = label_[u];
        edges_(u, [&](std::uint32_t v, std::uint32_t height, int edge) {
            const std::uint64_t reached = label + std::uint64_t{height} * edges_.length5(edge);
            if (reached >= kUnreached && label_[v] == kUnreached) fits_ = false;
            if (reached >= kUnreached || reached > label_[v]) return;
            if (reached == label_[v]) {
                if (parent_[v] != kNoNode && precedes(u, index(parent_[v]))) parent_[v] = NodeId{u};
                return;
            }
            const Place p = place(v, first);
            if (!p.is_near) {
                fits_ = false;
                return;
            }
            label_[v] = std::uint32_t(reached);
            parent_[v] = NodeId{u};
            if (p.beside == kSelf) {
                s.queue.push({bucket(label_[v]), v});
            } else {
                s.fallen[p.beside].push_back(v);
                visit.after[p.beside].add(label_[v], label_[v], 1, 1);
            }
        });
    }
    bool precedes(std::uint32_t a, std::uint32_t b) const {
        return label_[a] != label_[b] ? label_[a] < label_[b] : a < b;
    }

    void take_fallen(Scratch& s, int tile) {
        std::vector<std::uint32_t>& nodes = s.fallen[kSelf];
        {
            const std::lock_guard lock(mutex_);
            nodes.swap(fallen_[std::size_t(tile)]);
        }
        for (const std::uint32_t n : nodes) s.queue.push({bucket(label_[n]), n});
        nodes.clear();
    }
    void give_fallen(Scratch& s, int tile) {
        const std::lock_guard lock(mutex_);
        for (int beside = 0; beside < 9; ++beside) {
            std::vector<std::uint32_t>& nodes = s.fallen[std::size_t(beside)];
            if (nodes.empty()) continue;
            std::vector<std::uint32_t>& there =
                fallen_[std::size_t(tiling_.neighbour(tile, beside % 3 - 1, beside / 3 - 1))];
            there.insert(there.end(), nodes.begin(), nodes.end());
            nodes.clear();
        }
    }

    const Lattice& lattice_;
    const Edges edges_;
    const Tiling tiling_;
    const int bucket_bits_;
    const std::vector<Source>& sources_;
    const Work& work_;
    UnsetVector<std::uint32_t> label_;
    std::vector<NodeId> parent_;
    std::mutex mutex_;
    std::vector<std::vector<std::uint32_t>> fallen_;  // nodes of each tile whose labels fell since its last visit
    std::atomic<bool> fits_{true};
};

}  // namespace

std::optional<Plan> plan_listed(const PlanRequest& request, const std::vector<Source>& sources, const Work& work,
                                TileStats& stats) {
    if (request.graph.height_plane.empty()) return ListedSearch<ListedEdges<false>>(request, sources, work).run(stats);
    return ListedSearch<ListedEdges<true>>(request, sources, work).run(stats);
}

}  // namespace dstylize
