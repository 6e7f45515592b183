// Holdfast: a memory limit for programs whose users give none.
#pragma once

#include <cstdint>

#include "holdfast/export.h"

namespace holdfast {

/// In bytes, for `Limits::memory_limit`: 95 % of the memory of the machine, or of the limit of the container
/// (cgroup v2) if that is less. A run that needs more would end other programs, or be ended without a
/// message. 0, no limit, if the system does not report these or the memory of a process, or if it limits the
/// address space itself (`ulimit -v`), where an allocation fails in time.
[[nodiscard]] HOLDFAST_API std::uint64_t usual_memory_limit();

}  // namespace holdfast
