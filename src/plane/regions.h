// The regions that constraints separate from each other and from the outside.
#pragma once

#include <vector>

#include "plane/given_points.h"
#include "plane/triangles.h"

namespace holdfast::plane {

inline constexpr std::uint32_t kOutside = 0;

/// The region of each triangle: kOutside if no constraints separate it from the ghosts or from unconstrained
/// borders; the others are numbered from 1 in the order of their first triangles.
struct Regions {
  LargeVector<std::uint32_t> of_triangle;
  std::uint32_t count = 0;
};
[[nodiscard]] Regions find_regions(const Triangles& mesh);

/// For each place, a triangle that contains it, or kNoVertex.
struct Found {
  std::uint32_t triangle = kNoVertex;
  bool on_constraint = false;  ///< lies on a constrained edge or at an end of one
};
[[nodiscard]] std::vector<Found> find_triangles(const Triangles& mesh, Points& points,
                                                const GivenPoints& places);

}  // namespace holdfast::plane
