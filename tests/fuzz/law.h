#pragma once
#include <cstdio>
#include <cstdlib>

/// Ends the process, as libFuzzer wants it, when a law does not hold.
inline void law(bool holds, const char* name) {
    if (holds) return;
    std::fprintf(stderr, "broken: %s\n", name);
    std::abort();
}
