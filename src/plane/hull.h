// The convex hull as segments.
#pragma once

#include <vector>

#include "plane/sweep.h"

namespace holdfast::plane {

/// Adds the sides of the convex hull that are not segments yet, cut at the points on them. Collinear points
/// have no such sides.
void add_hull(const Points& points, std::vector<Ends>& segments);

}  // namespace holdfast::plane
