// Cuts a facet that other parts lie on, in its own plane.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "repair/led_sides.h"
#include "repair/part_facets.h"

namespace holdfast::repairing {

/// A piece of a facet that no side of another part divides further.
struct Cell {
  Index facet = 0;
  std::vector<Triangle> triangles;           // oriented as the facet
  std::vector<std::array<Index, 2>> border;  // ascending: exactly these are sides of an odd number of them
};

/// Cuts a facet with its led sides, the vertices `inside` it, and the `pieces` of other parts' sides between
/// vertices on it. Pieces that cross others are ignored. The borders of all cells together are the facet's
/// sides. `step` is called from time to time.
[[nodiscard]] std::vector<Cell> cut_facet(const PartFacets& facets, const LedSides& sides, Index f,
                                          std::span<const Index> inside,
                                          std::span<const std::array<Index, 2>> pieces, const Step& step);

}  // namespace holdfast::repairing
