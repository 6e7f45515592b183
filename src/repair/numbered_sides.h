// The sides of facets, each with a number.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "holdfast/types.h"

namespace holdfast::repairing {

struct NumberedSides {
  using Side = std::array<Index, 2>;  ///< places of two vertices, ascending

  std::vector<Side> all;                        ///< in the order in which they come first
  std::vector<std::array<Index, 3>> of_facets;  ///< those from corner 0 to 1, 1 to 2, and 2 to 0

  /// `place` is what stands for each vertex; two vertices with the same are one.
  NumberedSides(std::span<const Triangle> facets, std::span<const Index> place);
};

}  // namespace holdfast::repairing
