#include "refine/regular_elements.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/measure.h"

namespace holdfast {

std::vector<double> regular_elements(const VolumeData& volume) {
  std::vector<double> elements(volume.kept.size(), 0);
  const auto is_limit = [](double size) { return std::isfinite(size); };
  if (volume.most_sizes == nullptr ||
      std::none_of(volume.most_sizes->begin(), volume.most_sizes->end(), is_limit))
    return elements;
  for (Tet t = 0; t < volume.mesh.slot_count(); ++t) {
    if (!volume.is_inside(t)) continue;
    const double six = six_volumes(volume.mesh, volume.mesh.corners(t));
    if (!std::isfinite(six)) continue;  // beyond the range of doubles, as cubes of sizes may be
    const RegionId region = volume.region_of[t];
    const double size = volume.most_size(region);
    elements[region] += std::numbers::sqrt2 * (six / size / size / size);
  }
  return elements;
}

std::vector<double> elements_by_region(const VolumeData& volume) {
  std::vector<double> elements(volume.kept.size(), 0);
  for (Tet t = 0; t < volume.mesh.slot_count(); ++t)
    if (volume.is_inside(t)) ++elements[volume.region_of[t]];
  return elements;
}

}  // namespace holdfast
