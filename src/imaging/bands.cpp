#include "imaging/bands.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace dstylize {

void in_bands(std::size_t count, const std::function<void(std::size_t, std::size_t)>& body, std::size_t band) {
    const std::size_t bands = (count + band - 1) / band;
    if (bands < 2) return body(0, count);
    tbb::parallel_for(std::size_t{0}, bands, [&](std::size_t k) { body(k * band, std::min(count, (k + 1) * band)); });
}

}  // namespace dstylize
