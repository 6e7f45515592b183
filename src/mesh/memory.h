// How much memory the process holds, as the system tells it.
#pragma once

#include <cstdint>
#include <optional>

namespace holdfast {

/// Resident memory of the process, in bytes; nothing where `statm`, Linux's table, cannot be read.
[[nodiscard]] std::optional<std::uint64_t> resident_memory_bytes(const char* statm = "/proc/self/statm");

/// The most that it was; 0 where the system does not tell.
[[nodiscard]] std::uint64_t peak_memory_bytes();

}  // namespace holdfast
