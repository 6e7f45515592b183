// The sides of facets, each with a number.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "holdfast/types.h"

namespace holdfast::repairing {

struct NumberedSides {
  using Side = std::array<Index, 2>;  ///< places of two vertices, ascending

  std::vector<Side> all;                        ///< in order of first occurrence
  std::vector<std::array<Index, 3>> of_facets;  ///< the sides from corner 0 to 1, 1 to 2, and 2 to 0

  /// `place` holds the place of each vertex; vertices with the same place are one.
  NumberedSides(std::span<const Triangle> facets, std::span<const Index> place);
};

}  // namespace holdfast::repairing
