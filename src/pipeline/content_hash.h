#pragma once
#include <cstddef>
#include <span>
#include <string>

namespace dstylize {

/// XXH3-128 of a file's bytes, 32 hexadecimal digits: tells one file from another, proves nothing.
std::string content_hash(std::span<const std::byte> bytes);

}  // namespace dstylize
