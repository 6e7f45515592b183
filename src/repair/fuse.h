// Cuts nearly coincident interfaces of parts alike: facets bend, vertices stay.
#pragma once

#include <span>
#include <vector>

#include "repair/state.h"
#include "surface/search.h"

namespace holdfast::repairing {

/// Where two parts lie within `gap` of each other,
///   1. sides of one are routed through the vertices of the other that they pass;
///   2. where a side of each passes the other, both are routed through a new vertex;
///   3. coincident facets are triangulated again, once for both, with all of these sides; other facets with a
///      side that was cut are cut with it.
/// `rounding` is the distance that rounding alone may put a facet off its plane.
/// `part` holds the part of each facet of the input. Facets that several parts share already, degenerate
/// facets, and facets that do not lie in one plane together stay as they are. Returns the largest distance by
/// which anything was bent, rounded up.
double fuse(State& state, std::span<const Index> part, double gap, double rounding, const Step& step);

}  // namespace holdfast::repairing
