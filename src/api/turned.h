// The orientation of the parts of a facet.
#pragma once

#include <span>

#include "holdfast/types.h"

namespace holdfast {

/// Whether a part of a facet has the facet's orientation, by their normals.
[[nodiscard]] inline bool turned_alike(std::span<const Point> points, const Triangle& part,
                                       std::span<const Point> before, const Triangle& facet) {
  const auto normal = [](std::span<const Point> of, const Triangle& t) {
    std::array<long double, 3> u{}, v{};
    for (std::size_t k = 0; k < 3; ++k) {
      u[k] = static_cast<long double>(of[t[1]][k]) - static_cast<long double>(of[t[0]][k]);
      v[k] = static_cast<long double>(of[t[2]][k]) - static_cast<long double>(of[t[0]][k]);
    }
    return std::array<long double, 3>{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                                      u[0] * v[1] - u[1] * v[0]};
  };
  const auto a = normal(points, part), b = normal(before, facet);
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] >= 0;
}

}  // namespace holdfast
