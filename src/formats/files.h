#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace dstylize {

/// The bytes of a file; "-" is standard input. Throws Error(cannot_read) when it is missing, a folder,
/// unreadable or longer than `max_bytes`.
std::vector<std::byte> read_file(const std::filesystem::path& path, std::uint64_t max_bytes);

/// Puts a file in place whole or not at all: temporary file beside the target, fsync, rename, fsync of
/// the folder. A target that is a symbolic link stays one: the file that it points to is replaced. The
/// mode of an existing target is kept, and one that may not be written is not replaced. Targets that
/// are no regular file (a pipe, a device) are written directly, "-" is standard output.
/// Throws Error(cannot_write); then an existing target is as it was and nothing is left behind, unless what failed is
/// the very last step: the new file is whole and in place, but the folder may forget it when the power fails.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// The same for a file that must not exist yet: of several programs that create it at the same time, one does.
/// Returns whether it is ours; one that exists stays as it is.
bool create_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);

}  // namespace dstylize
