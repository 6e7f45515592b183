// The kept regions and their ids, by the holes and seeds of the input.
#pragma once

#include <vector>

#include "holdfast/plane.h"
#include "plane/draft.h"
#include "plane/regions.h"

namespace holdfast::plane {

/// By region: whether it is kept, its number, and the most that a triangle may measure there (0: no limit).
struct Chosen {
  Regions regions;
  std::vector<bool> kept;
  std::vector<int> ids;
  std::vector<double> areas;
  /// Whether a hole or seed may lie on a segment: on sides of the hull that are none it may.
  bool on_constraint = false;

  [[nodiscard]] bool keeps(std::uint32_t triangle) const { return kept[regions.of_triangle[triangle]]; }
  [[nodiscard]] int id_of(std::uint32_t triangle) const { return ids[regions.of_triangle[triangle]]; }
  /// Of kept ones.
  [[nodiscard]] std::size_t count() const;
};

/// Regions without a hole are kept, each with the number of its seed, or the next from 1 on that no seed has.
[[nodiscard]] Chosen choose_regions(Draft& draft, const Plane& plane, PlaneMethod method);

}  // namespace holdfast::plane
