// How many elements there are by region, and how many the user's sizes ask for: as many regular tetrahedra
// of that edge as fill the region.
#pragma once

#include <vector>

#include "refine/volume_data.h"

namespace holdfast {

/// By region, those that its limit on sizes asks for; 0 without a limit, and for a region that is not kept.
[[nodiscard]] std::vector<double> regular_elements(const VolumeData& volume);

/// By region, those that there are.
[[nodiscard]] std::vector<double> elements_by_region(const VolumeData& volume);

}  // namespace holdfast
