#pragma once
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>

#include "core/work.h"

namespace dstylize {

inline int thread_count(const Work& work) {
    return work.threads > 0 ? work.threads : tbb::this_task_arena::max_concurrency();
}

/// Calls body(worker) for each of so many workers, of which some may run after one another. They are the caller's
/// threads: one that does other work now can come later.
template <class Body>
void run_workers(int workers, const Body& body) {
    tbb::parallel_for(0, workers, body, tbb::simple_partitioner());
}

/// Calls body(first, end) for parts that together are the indices below `count`, one for each worker.
template <class Body>
void share_out(std::size_t count, const Work& work, const Body& body) {
    const std::size_t workers = std::min(std::size_t(thread_count(work)), count);
    run_workers(int(workers), [&](int worker) {
        const std::size_t w = std::size_t(worker);
        body(count * w / workers, count * (w + 1) / workers);
    });
}

}  // namespace dstylize
