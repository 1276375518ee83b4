#pragma once
#include <cstddef>
#include <functional>

namespace dstylize {

/// Indices of one band where an index is a pixel or a node, and where it is a branch or a stroke.
constexpr std::size_t kBandOfNodes = std::size_t{1} << 15, kBandOfBranches = std::size_t{1} << 8;

/// Calls body(begin, end) for bands that together are the indices below `count`, on all threads of the task arena;
/// few indices in one call. What a band does must not depend on another one.
void in_bands(std::size_t count, const std::function<void(std::size_t, std::size_t)>& body,
              std::size_t band = kBandOfNodes);

/// Calls f(n) for every index below `count`, band by band.
template <class F>
void each_index(std::size_t count, F f, std::size_t band = kBandOfNodes) {
    const auto each_of_band = [&f](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) f(n);
    };
    in_bands(count, each_of_band, band);
}

}  // namespace dstylize
