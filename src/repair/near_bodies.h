// Finds bodies that nearly touch. Bodies are sets of facets that are connected by sides.
#pragma once

#include <cstddef>

#include "repair/state.h"
#include "surface/search.h"

namespace holdfast::repairing {

struct NearBodies {
  std::size_t facets = 0;    ///< that overlap facets of another body, nearly in one plane
  double thickness = 0;      ///< the largest of such facets together, but at most what was asked for
  std::size_t edges = 0;     ///< pairs of sides that pass each other, but do not meet
  double edge_distance = 0;  ///< the largest of such sides
};

/// What lies at most `widest` away from another body.
[[nodiscard]] NearBodies near_bodies(const State& state, double widest, const Step& step);

}  // namespace holdfast::repairing
