#pragma once

namespace dstylize::test {

/// Whether this is a sanitizer's build: slow, and nothing may be preloaded into it.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace dstylize::test
