// From points and segments to triangles: the course of a run.
#pragma once

#include "holdfast/plane.h"
#include "plane/triangles.h"

namespace holdfast::plane {

/// As holdfast::triangulate, but limits throw. `poll` is called with the share of the work that is done.
[[nodiscard]] PlaneResult triangulate(const Plane& plane, const PlaneOptions& options, const Poll& poll);

}  // namespace holdfast::plane
