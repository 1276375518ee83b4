#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace dstylize::codec {

using Bytes = std::span<const std::byte>;

enum class Endian { little, big };

/// `size` bytes from `offset`, or fewer where the data ends: hostile offsets are safe.
inline Bytes part(Bytes data, std::size_t offset, std::size_t size = std::size_t(-1)) {
    offset = std::min(offset, data.size());
    return data.subspan(offset, std::min(size, data.size() - offset));
}

/// An unsigned integer of `size` bytes at `offset`; 0 where the data ends before.
inline std::uint64_t integer_at(Bytes data, std::size_t offset, int size, Endian endian) {
    const Bytes bytes = part(data, offset, std::size_t(size));
    if (bytes.size() < std::size_t(size)) return 0;
    std::uint64_t value = 0;
    for (int i = 0; i < size; ++i)
        value =
            value << 8 | std::to_integer<std::uint64_t>(bytes[std::size_t(endian == Endian::big ? i : size - 1 - i)]);
    return value;
}

inline std::string_view text_of(Bytes bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }
inline Bytes bytes_of(std::string_view text) { return std::as_bytes(std::span(text)); }
inline bool starts_with(Bytes data, std::string_view magic) { return text_of(part(data, 0, magic.size())) == magic; }

/// Appends an unsigned integer of `size` bytes.
inline void append_integer(std::string& data, std::uint64_t value, int size, Endian endian) {
    for (int i = 0; i < size; ++i)
        data += static_cast<char>(value >> 8 * (endian == Endian::big ? size - 1 - i : i) & 0xff);
}

}  // namespace dstylize::codec
