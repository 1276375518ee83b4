#pragma once

#include <cstdint>

namespace dstylize::test {

/// Whether this is a sanitizer's build: slow, and nothing may be preloaded into it.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

/// How many of `cases` random ones a test takes: a twentieth under a sanitizer, where each takes ten times as long.
constexpr std::uint32_t fewer_if_sanitized(std::uint32_t cases) { return kSanitized ? cases / 20 : cases; }

}  // namespace dstylize::test
