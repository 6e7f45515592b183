// Fills a part of a volume separately, for the optimisation of the whole (optimise/fill_anew.h).
#pragma once

#include <optional>

#include "holdfast/holdfast.h"
#include "mesh/monitor.h"
#include "optimise/optimise.h"

namespace holdfast {

/// Fills a polyhedron without field points, in random orders independent of those of the whole. The limits
/// are those of the call, whose monitor is polled. Returns nullopt if the polyhedron is not a valid complex,
/// some point has no doubles, or it takes more points than allowed.
[[nodiscard]] std::optional<Filling> fill_polyhedron(const Complex& polyhedron, PointsOfFilling points,
                                                     const Limits& limits, Monitor& whole);

}  // namespace holdfast
