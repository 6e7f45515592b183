#include "holdfast/memory.h"

#include <optional>

#include "mesh/memory.h"

namespace holdfast {

std::uint64_t usual_memory_limit() {
  const std::optional<std::uint64_t> all = machine_memory_bytes();
  return all && resident_memory_bytes() ? *all - *all / 20 : 0;
}

}  // namespace holdfast
