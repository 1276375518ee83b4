// How the allocator of both programs, jemalloc, asks the system for memory: in huge pages, where there are any.
//
// A plan goes once over arrays of tens or hundreds of megabytes, which are new each time. In pages of 4 KB the
// system clears and maps them by tens of thousands of interruptions, which can take longer than the plan; the
// C library's allocator gives every large array back at once, so that it is the same again with the next one.
// dstylize itself gives nothing back: a second round, or the next picture of a folder, takes what the last one freed.
// The library leaves the choice to those that link it.
#include <jemalloc/jemalloc.h>

// NOLINTBEGIN(*-non-const-global-variables): jemalloc reads it by this name before main()
#ifdef DSTYLIZE_LIMITED_ADDRESS_SPACE
const char* malloc_conf = "thp:always,retain:false";  // keeps no addresses that it does not use
#else
const char* malloc_conf = "thp:always,dirty_decay_ms:-1";
#endif
// NOLINTEND(*-non-const-global-variables)
