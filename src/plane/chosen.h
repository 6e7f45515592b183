// The kept regions and their ids, by the holes and seeds of the input.
#pragma once

#include <vector>

#include "holdfast/plane.h"
#include "plane/draft.h"
#include "plane/regions.h"

namespace holdfast::plane {

/// By region: whether it is kept, its number, and the area limit of its triangles (0: none).
struct Chosen {
  Regions regions;
  std::vector<bool> kept;
  std::vector<int> ids;
  std::vector<double> areas;
  /// Whether a hole or seed lies on a constraint. It may lie on a side of the hull that is no constraint.
  bool on_constraint = false;
  std::vector<Index> idle_holes, idle_seeds;  ///< see PlaneReport

  [[nodiscard]] bool keeps(std::uint32_t triangle) const { return kept[regions.of_triangle[triangle]]; }
  [[nodiscard]] int id_of(std::uint32_t triangle) const { return ids[regions.of_triangle[triangle]]; }
  /// The number of kept regions.
  [[nodiscard]] std::size_t count() const;
};

/// Regions without a hole are kept, each with the number of its seed or else the next unused number from 1
/// on.
[[nodiscard]] Chosen choose_regions(Draft& draft, const Plane& plane, PlaneMethod method);

}  // namespace holdfast::plane
