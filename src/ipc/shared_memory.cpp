#include "ipc/shared_memory.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

namespace dstylize::ipc {
namespace {

[[noreturn]] void fail(const char* what, int error = errno) {
    throw std::system_error(error, std::generic_category(), what);
}

}  // namespace

Descriptor shared_memory(std::uint64_t bytes) {
    Descriptor memory(memfd_create("dstylize", MFD_CLOEXEC));
    if (!memory) fail("memfd_create");
    if (bytes > std::uint64_t(INT64_MAX) || ftruncate(memory.number(), off_t(bytes)) != 0) fail("ftruncate");
    return memory;
}

std::uint64_t size_bytes(const Descriptor& file) {
    struct stat status {};
    return file && fstat(file.number(), &status) == 0 ? std::uint64_t(status.st_size) : 0;
}

void write_all(const Descriptor& file, std::span<const std::byte> bytes, std::uint64_t offset) {
    while (!bytes.empty()) {
        const ssize_t n = pwrite(file.number(), bytes.data(), bytes.size(), off_t(offset));
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) fail("write", n < 0 ? errno : EIO);
        bytes = bytes.subspan(std::size_t(n));
        offset += std::uint64_t(n);
    }
}

void read_all(const Descriptor& file, std::span<std::byte> bytes, std::uint64_t offset) {
    while (!bytes.empty()) {
        const ssize_t n = pread(file.number(), bytes.data(), bytes.size(), off_t(offset));
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) fail("read", n < 0 ? errno : EIO);
        bytes = bytes.subspan(std::size_t(n));
        offset += std::uint64_t(n);
    }
}

void drain(const Descriptor& memory, std::span<std::byte> bytes, std::uint64_t offset) {
    constexpr std::size_t kPart = std::size_t(8) << 20;
    while (!bytes.empty()) {
        const std::size_t n = std::min(bytes.size(), kPart);
        read_all(memory, bytes.first(n), offset);
        // Only saves memory: a failure changes nothing.
        (void)fallocate(memory.number(), FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, off_t(offset), off_t(n));
        bytes = bytes.subspan(n);
        offset += n;
    }
}

Mapping::Mapping(const Descriptor& file, std::uint64_t bytes, bool writable) {
    if (bytes == 0) return;
    void* start = mmap(nullptr, bytes, writable ? PROT_READ | PROT_WRITE : PROT_READ, MAP_SHARED, file.number(), 0);
    if (start == MAP_FAILED) fail("mmap");
    start_ = static_cast<std::byte*>(start);
    size_ = bytes;
}

Mapping::Mapping(Mapping&& other) noexcept
    : start_(std::exchange(other.start_, nullptr)), size_(std::exchange(other.size_, 0)) {}

Mapping& Mapping::operator=(Mapping&& other) noexcept {
    std::swap(start_, other.start_);
    std::swap(size_, other.size_);
    return *this;
}

Mapping::~Mapping() {
    if (start_) munmap(start_, size_);
}

}  // namespace dstylize::ipc
