#include "graph/detail_owners.h"

#include <algorithm>
#include <atomic>

#include "graph/detail_workers.h"

namespace dstylize {
namespace {

/// Entries of the owners' palette: 0 for none. Each node once: up to where the owner is known, and back. Threads may
/// meet on a way, and then write the same.
template <class Entry>
UnsetVector<Entry> entries_by_parents(const ParentColumn& parent, const std::vector<Source>& sources,
                                      const std::vector<Entry>& of_source, const Work& work) {
    UnsetVector<Entry> entry(parent.size());
    share_out(entry.size(), work, [&](std::size_t first, std::size_t end) {
        std::fill(entry.begin() + std::ptrdiff_t(first), entry.begin() + std::ptrdiff_t(end), Entry{0});
    });
    for (std::size_t k = 0; k < sources.size(); ++k)
        if (parent[index(sources[k].node)] == kNoNode) entry[index(sources[k].node)] = of_source[k];
    const auto known = [&](std::size_t n) { return std::atomic_ref(entry[n]).load(std::memory_order_relaxed); };
    share_out(entry.size(), work, [&](std::size_t first, std::size_t end) {
        std::vector<std::size_t> way;
        for (std::size_t n = first; n < end; ++n) {
            if (known(n) != 0 || parent[n] == kNoNode) continue;
            std::size_t at = n;
            Entry owner = 0;
            for (; (owner = known(at)) == 0; at = index(parent[at])) way.push_back(at);
            for (const std::size_t on_way : way) std::atomic_ref(entry[on_way]).store(owner, std::memory_order_relaxed);
            way.clear();
        }
    });
    return entry;
}

}  // namespace

OwnerColumn owners_by_parents(const ParentColumn& parent, const std::vector<Source>& sources, const Work& work) {
    std::vector<std::uint16_t> palette;
    for (const Source& s : sources) palette.push_back(s.owner);
    std::sort(palette.begin(), palette.end());
    palette.erase(std::unique(palette.begin(), palette.end()), palette.end());
    palette.insert(palette.begin(), Plan::kNoOwner);
    if (palette.size() == 2) {
        UnsetVector<std::uint8_t> entry(parent.size());
        share_out(parent.size(), work, [&](std::size_t first, std::size_t end) {
            const std::span<const std::uint8_t> steps = parent.steps();
            if (steps.empty())
                for (std::size_t n = first; n < end; ++n) entry[n] = parent[n] != kNoNode;
            else  // many at a time
                std::transform(steps.begin() + std::ptrdiff_t(first), steps.begin() + std::ptrdiff_t(end),
                               entry.begin() + std::ptrdiff_t(first),
                               [](std::uint8_t step) { return std::uint8_t(step != ParentColumn::kNoStep); });
        });
        for (const Source& s : sources) entry[index(s.node)] = 1;
        return {std::move(palette), std::move(entry)};
    }
    std::vector<std::uint16_t> of_source;
    for (const Source& s : sources)
        of_source.push_back(
            std::uint16_t(std::lower_bound(palette.begin() + 1, palette.end(), s.owner) - palette.begin()));
    if (palette.size() <= 256) {
        const std::vector<std::uint8_t> narrow(of_source.begin(), of_source.end());
        return {std::move(palette), entries_by_parents(parent, sources, narrow, work)};
    }
    const UnsetVector<std::uint16_t> entry = entries_by_parents(parent, sources, of_source, work);
    std::vector<std::uint16_t> owner(entry.size());
    share_out(owner.size(), work, [&](std::size_t first, std::size_t end) {
        for (std::size_t n = first; n < end; ++n) owner[n] = palette[entry[n]];
    });
    return owner;
}

}  // namespace dstylize
