#pragma once

#include "holdfast/types.h"

namespace holdfast::division {

/// The mean of a tetrahedron's corners, rounded.
[[nodiscard]] inline Point centre(const std::array<Point, 4>& corners) {
  Point p{};
  for (std::size_t k = 0; k < 3; ++k)
    for (const Point& corner : corners) p[k] += corner[k] / 4;
  return p;
}
[[nodiscard]] inline Point centre(const Volume& volume, const Tetrahedron& t) {
  return centre({volume.vertices[t[0]], volume.vertices[t[1]], volume.vertices[t[2]], volume.vertices[t[3]]});
}

}  // namespace holdfast::division
