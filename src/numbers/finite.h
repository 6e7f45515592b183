// Tests for points that are not finite: files may contain them, but no predicate accepts them.
#pragma once

#include <array>
#include <cmath>

namespace holdfast {

[[nodiscard]] inline bool is_finite(const std::array<double, 3>& p) {
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

}  // namespace holdfast
