// The memory of the process, as reported by the system.
#pragma once

#include <cstdint>
#include <optional>

namespace holdfast {

/// Resident memory of the process, in bytes; nothing if `statm`, Linux's table, cannot be read.
[[nodiscard]] std::optional<std::uint64_t> resident_memory_bytes(const char* statm = "/proc/self/statm");

/// The largest value so far; 0 if the system does not report it.
[[nodiscard]] std::uint64_t peak_memory_bytes();

}  // namespace holdfast
