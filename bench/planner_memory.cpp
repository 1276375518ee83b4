// Memory is what the system counts, as it is this that a machine runs out of: the process's pages that are in memory
// at the peak of a plan (VmHWM, set back to what is in memory before it), huge pages, the allocator's rounding and
// stacks and all. What was freed before goes back to the system first, or the plan would take it again uncounted.
#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <string>

#ifdef DSTYLIZE_WITH_JEMALLOC
#include <jemalloc/jemalloc.h>
#else
#include <malloc.h>
#endif

#include "core/error.h"
#include "graph/tile_planner.h"
#include "planner_tables.h"
#include "planner_timing.h"
#include "weight_maps.h"

namespace dstylize {
namespace {

void give_back_what_is_free() {
#ifdef DSTYLIZE_WITH_JEMALLOC
#define DSTYLIZE_PURGE_2(arena) "arena." #arena ".purge"
#define DSTYLIZE_PURGE(arena) DSTYLIZE_PURGE_2(arena)
    mallctl(DSTYLIZE_PURGE(MALLCTL_ARENAS_ALL), nullptr, nullptr, nullptr, 0);
#else
    malloc_trim(0);
#endif
}

/// A line of this process's state, such as "VmRSS:", in bytes.
double bytes_of(const std::string& name) {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        double kilobytes = 0;
        if (word == name && status >> kilobytes) return kilobytes * 1024;
    }
    throw Error(ErrorCode::cannot_read, "/proc/self/status", "has no " + name, "leave --memory out");
}

void set_peak_back() {
    std::ofstream file("/proc/self/clear_refs");
    file << 5;
    if (!file.flush())
        throw Error(ErrorCode::cannot_write, "/proc/self/clear_refs", "cannot be written", "leave --memory out");
}

double peak_per_node(const WeightedLattice& g, Metric metric) {
    const Source source[] = {{map_source(g.lattice), 0, 0}};
    give_back_what_is_free();
    set_peak_back();
    const double before = bytes_of("VmRSS:");
    double time = 0;
    const Plan plan = planned(tile_planner(), {g, source, metric}, 1, 1, time);
    return (bytes_of("VmHWM:") - before) / double(plan.label.size());
}

}  // namespace

bool show_memory(double mega) {
    struct Case {
        Metric metric;
        double bar;
    };
    constexpr Case kCases[] = {{Metric::sum, 6}, {Metric::lexicographic, 6}, {Metric::max_sum, 11}};
    fmt::print("peak memory of a plan by one thread beyond the weights, {} megapixels\n", mega);
    fmt::print("{:<15}{:<10}{:>15}  bar\n", "metric", "map", "bytes per node");
    bool ok = true;
    for (const char* const map : {"portrait", "noise"}) {
        const WeightedLattice g = weight_map(map, mega, Neighbourhood::square8);
        for (const Case& c : kCases) {
            const double bytes = peak_per_node(g, c.metric);
            const bool good = stays_below(bytes, c.bar);
            fmt::print("{:<15}{:<10}{:>15.2f}  {:g}{}\n", metric_names()[std::size_t(c.metric)], map, bytes, c.bar,
                       good ? "" : "  TOO MUCH");
            std::fflush(stdout);
            ok = ok && good;
        }
    }
    return ok;
}

}  // namespace dstylize
