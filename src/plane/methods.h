// Triangles of points and segments by one of the paper's three methods. Points may be exact.
#pragma once

#include <optional>
#include <span>

#include "holdfast/plane.h"
#include "plane/draft.h"
#include "plane/given_points.h"
#include "plane/stages.h"

namespace holdfast::plane {

/// The triangles of the whole, constrained Delaunay where that is asked for, unless the run stops before; of
/// swaps and partition none where all points lie on one line, whatever the segments are. Nothing where points
/// are at one place, or segments meet other than in common ends. Counts go to `result`, and what stands where
/// the run stops.
[[nodiscard]] std::optional<Draft> triangles_by_method(const GivenPoints& points,
                                                       std::span<const Segment> segments,
                                                       const PlaneOptions& options, PlaneResult& result,
                                                       Stages& stages);

}  // namespace holdfast::plane
