#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "ipc/descriptor.h"

namespace dstylize::ipc {

/// Anonymous memory (memfd) of `bytes` zeros that can be passed to another process; it is freed with its
/// last descriptor and mapping. Throws std::system_error, also when `bytes` cannot be had.
Descriptor shared_memory(std::uint64_t bytes);

/// Size of an open file in bytes; 0 when it cannot be told.
std::uint64_t size_bytes(const Descriptor& file);

/// Throws std::system_error (ENOSPC and the like) unless all bytes are written at `offset`.
void write_all(const Descriptor& file, std::span<const std::byte> bytes, std::uint64_t offset = 0);

/// Reads until `bytes` is full. Throws std::system_error when the file is shorter.
void read_all(const Descriptor& file, std::span<std::byte> bytes, std::uint64_t offset = 0);

/// Like read_all, and gives each part of the memory back to the system as soon as it is copied: the two
/// copies are never both whole.
void drain(const Descriptor& memory, std::span<std::byte> bytes, std::uint64_t offset = 0);

/// A file's bytes in the address space for as long as this lives.
class Mapping {
  public:
    Mapping() = default;
    /// Throws std::system_error. An empty file gives an empty span.
    Mapping(const Descriptor& file, std::uint64_t bytes, bool writable);
    Mapping(const Mapping&) = delete;
    Mapping& operator=(const Mapping&) = delete;
    Mapping(Mapping&& other) noexcept;
    Mapping& operator=(Mapping&& other) noexcept;
    ~Mapping();
    std::span<std::byte> bytes() const { return {start_, size_}; }

  private:
    std::byte* start_ = nullptr;
    std::size_t size_ = 0;
};

}  // namespace dstylize::ipc
