// Triangles of a polygon by cutting off its corners (paper §2.1).
#pragma once

#include <span>
#include <vector>

#include "holdfast/plane.h"
#include "plane/triangles.h"

namespace holdfast::plane {

struct EarCounts {
  std::size_t ears = 0;    ///< triangles cut off
  std::size_t joined = 0;  ///< triangles made with the reflex corner nearest to a side
};

/// Triangulates the face on the left of a closed walk, which may pass vertices and edges twice, and adds its
/// triangles.
void cut_ears(const Points& points, std::span<const Vertex> walk, PlaneEars choice,
              std::vector<std::array<Vertex, 3>>& triangles, EarCounts& counts);

}  // namespace holdfast::plane
