// Triangles in the plane between points that may be exact: for callers within the library.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "holdfast/plane.h"
#include "plane/polygon.h"

namespace holdfast::plane {

/// The counterpart of holdfast::Plane for exact points. The doubles nearest to points and holes must be
/// finite.
struct ExactPlane {
  Points points;
  std::vector<Segment> segments;
  Points holes;
};

/// The triangles of holdfast::triangulate, by the same code and any method, counterclockwise, as point
/// numbers. Returns nullopt if the plane is not valid. Options that refine or stop after a stage are not
/// allowed.
[[nodiscard]] std::optional<std::vector<Corners3>> triangulate(const ExactPlane& plane,
                                                               const PlaneOptions& options,
                                                               PlaneReport& report, const Poll& poll);

}  // namespace holdfast::plane
