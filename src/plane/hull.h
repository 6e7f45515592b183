// The convex hull as segments.
#pragma once

#include <vector>

#include "plane/sweep.h"

namespace holdfast::plane {

/// Adds the sides of the convex hull, cut at the points on them, that are not among the segments yet. Points
/// on one line have no such sides.
void add_hull(const Points& points, std::vector<Ends>& segments);

}  // namespace holdfast::plane
