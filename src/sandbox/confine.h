#pragma once
#include <cstdint>

namespace dstylize::sandbox {

/// What a process has given up for good, as far as the kernel lets it.
struct Confinement {
    /// Everything but computing, memory, threads of its own and the descriptors that it holds: no socket, no new
    /// process or program, no file opened for writing, no signal to others, no limit raised, no code made at run
    /// time. What is refused fails with EPERM.
    bool system_calls = false;
    /// No file is opened, whatever for, but memory that it holds (through /proc/self/fd).
    bool files = false;
};

/// Limits this process, and those that it forks, to `max_memory_bytes` more address space than it uses now and to
/// that much in any one piece of shared memory; no core dump, few descriptors, no look into it by others. Costs under
/// a millisecond. Every kernel has these limits.
void limit_resources(std::uint64_t max_memory_bytes);

/// Confines all threads of this process, which has loaded all the libraries that it needs. Never throws: what the
/// kernel lacks or refuses stays false. Costs about a millisecond.
Confinement confine() noexcept;

}  // namespace dstylize::sandbox
