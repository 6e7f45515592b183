// Boxes round points, which show whether two files have places in common.
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <span>
#include <string>

#include "holdfast/types.h"

namespace holdfast::cli {

/// The least and the largest coordinates.
struct Extent {
  Point low, high;

  [[nodiscard]] bool meets(const Extent& other) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (high[k] < other.low[k] || other.high[k] < low[k]) return false;
    return true;
  }
};

/// Without points, the extent meets nothing.
[[nodiscard]] inline Extent extent_of(std::span<const Point> points) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  Extent extent{{infinite, infinite, infinite}, {-infinite, -infinite, -infinite}};
  for (const Point& p : points)
    for (std::size_t k = 0; k < 3; ++k) {
      extent.low[k] = std::min(extent.low[k], p[k]);
      extent.high[k] = std::max(extent.high[k], p[k]);
    }
  return extent;
}

[[nodiscard]] inline std::string words_for(const Extent& e) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g})", e.low[0], e.low[1], e.low[2],
                     e.high[0], e.high[1], e.high[2]);
}

}  // namespace holdfast::cli
