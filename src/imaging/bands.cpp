#include "imaging/bands.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace dstylize {

void in_bands(std::size_t count, const std::function<void(std::size_t, std::size_t)>& body) {
    constexpr std::size_t kBand = std::size_t{1} << 15;
    const std::size_t bands = (count + kBand - 1) / kBand;
    if (bands < 2) return body(0, count);
    tbb::parallel_for(std::size_t{0}, bands,
                      [&](std::size_t band) { body(band * kBand, std::min(count, (band + 1) * kBand)); });
}

}  // namespace dstylize
