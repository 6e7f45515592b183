// What makes points and segments in the plane invalid, all of it, by name.
#pragma once

#include "holdfast/plane.h"
#include "plane/triangles.h"

namespace holdfast::plane {

/// Everything that is wrong, at most `most` of each kind; exact.
[[nodiscard]] std::vector<Defect> find_defects(const Plane& plane, std::size_t most, const Poll& poll);

}  // namespace holdfast::plane
