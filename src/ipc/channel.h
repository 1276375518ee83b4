#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>

#include "ipc/descriptor.h"

namespace dstylize::ipc {

/// Two connected ends of a message channel (SOCK_SEQPACKET: one send is one receive). Both ends close
/// on exec. Throws std::system_error.
std::pair<Descriptor, Descriptor> connected_pair();

/// Sends one message, with a descriptor when `passed` >= 0. False when the other end is gone; never
/// raises SIGPIPE.
bool send_message(const Descriptor& channel, std::span<const std::byte> message, int passed = -1);

enum class Arrival { message, hangup, timeout };

/// Waits for one message of exactly `message.size()` bytes; any other length counts as a hangup, as does
/// the other end's death. `timeout_ms` < 0 waits for ever; a signal restarts the wait.
Arrival receive_message(const Descriptor& channel, std::span<std::byte> message, Descriptor& passed, int timeout_ms);

/// The same for a plain struct.
template <class T>
requires std::is_trivially_copyable_v<T>
bool send_struct(const Descriptor& channel, const T& message, int passed = -1) {
    return send_message(channel, std::as_bytes(std::span(&message, 1)), passed);
}
template <class T>
requires std::is_trivially_copyable_v<T> Arrival receive_struct(const Descriptor& channel, T& message,
                                                                Descriptor& passed, int timeout_ms = -1) {
    return receive_message(channel, std::as_writable_bytes(std::span(&message, 1)), passed, timeout_ms);
}

}  // namespace dstylize::ipc
