#pragma once
#include <cstdint>

/// The codec's work: greets on the channel, then answers requests until it closes, each with at most
/// `max_memory_bytes` more address space than the libraries take. Returns the exit code when it cannot greet,
/// else ends the process.
extern "C" int dstylize_codec(std::uint64_t max_memory_bytes);
