// The memory of the process, as reported by the system.
#pragma once

#include <cstdint>
#include <optional>

namespace holdfast {

/// Resident memory of the process, in bytes; nothing if `statm`, Linux's table, cannot be read.
[[nodiscard]] std::optional<std::uint64_t> resident_memory_bytes(const char* statm = "/proc/self/statm");

/// The largest value so far; 0 if the system does not report it.
[[nodiscard]] std::uint64_t peak_memory_bytes();

/// The memory that the process may use: that of the machine, or less if its container has a limit (cgroup v2)
/// in the file `most`. Nothing if the system does not say.
[[nodiscard]] std::optional<std::uint64_t> machine_memory_bytes(
    const char* most = "/sys/fs/cgroup/memory.max");

}  // namespace holdfast
