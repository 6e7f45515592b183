// All defects that make points and segments in the plane invalid.
#pragma once

#include "holdfast/plane.h"
#include "plane/triangles.h"

namespace holdfast::plane {

/// All defects, at most `most` of each kind; exact.
[[nodiscard]] std::vector<Defect> find_defects(const Plane& plane, std::size_t most, const Poll& poll);

}  // namespace holdfast::plane
