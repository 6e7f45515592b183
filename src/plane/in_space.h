// Triangles of planes in space. Each plane is triangulated by itself.
#pragma once

#include "holdfast/plane.h"
#include "plane/triangles.h"

namespace holdfast::plane {

/// As holdfast::triangulate, but limits throw.
[[nodiscard]] PlaneResult triangulate(const PlanesInSpace& planes, const PlaneOptions& options,
                                      const Poll& poll);

}  // namespace holdfast::plane
