#include "pipeline/version.h"

namespace dstylize {

std::string_view version() { return DSTYLIZE_VERSION; }

}  // namespace dstylize
