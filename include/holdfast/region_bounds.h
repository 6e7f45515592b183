// Holdfast: bounds on the volumes of tetrahedra by region, where the region's id is all that is known of it.
#pragma once

#include <cmath>
#include <limits>

#include "holdfast/types.h"

namespace holdfast {

/// For `Options::regions`: bounds the region that has this id in the result, whatever gives it the id
/// (another seed, a part, or its turn). It numbers nothing. An id that the result does not have is told as
/// std::invalid_argument as soon as the regions are known.
[[nodiscard]] inline Surface::RegionSeed bound_of_region(int id, double max_volume) {
  constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
  return {{nowhere, nowhere, nowhere}, id, 0, max_volume};
}

/// Whether a seed is such a bound, and lies nowhere.
[[nodiscard]] inline bool is_bound_alone(const Surface::RegionSeed& seed) {
  return std::isnan(seed.where[0]) && std::isnan(seed.where[1]) && std::isnan(seed.where[2]) &&
         seed.max_volume > 0;
}

}  // namespace holdfast
