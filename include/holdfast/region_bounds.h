// Holdfast: bounds on the volumes of tetrahedra of a region that is known only by its id.
#pragma once

#include <cmath>
#include <limits>

#include "holdfast/types.h"

namespace holdfast {

/// For `Options::regions`: bounds the region that has this id in the result, whether the id comes from
/// another seed, from a part or by counting. The bound itself gives no ids. If the result has no such id,
/// std::invalid_argument is thrown as soon as the regions are known.
[[nodiscard]] inline Surface::RegionSeed bound_of_region(int id, double max_volume) {
  constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
  return {{nowhere, nowhere, nowhere}, id, 0, max_volume};
}

/// Whether a seed is such a bound, without a place.
[[nodiscard]] inline bool is_bound_alone(const Surface::RegionSeed& seed) {
  return std::isnan(seed.where[0]) && std::isnan(seed.where[1]) && std::isnan(seed.where[2]) &&
         seed.max_volume > 0;
}

}  // namespace holdfast
