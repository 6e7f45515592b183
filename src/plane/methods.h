// Triangles of points and segments by one of the paper's three methods. Points may be exact.
#pragma once

#include <optional>
#include <span>

#include "holdfast/plane.h"
#include "plane/draft.h"
#include "plane/given_points.h"
#include "plane/stages.h"

namespace holdfast::plane {

/// The triangles of the whole, constrained Delaunay if that is asked for, unless the run stops before. Swaps
/// and partition give none if all points are collinear, whatever the segments are. Returns nullopt if points
/// coincide or segments meet other than in common ends. Counts go to `result`, and so does the state at which
/// the run stops.
[[nodiscard]] std::optional<Draft> triangles_by_method(const GivenPoints& points,
                                                       std::span<const Segment> segments,
                                                       const PlaneOptions& options, PlaneResult& result,
                                                       Stages& stages);

}  // namespace holdfast::plane
