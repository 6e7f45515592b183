// Holdfast: smooth patches of a surface as its markers.
#pragma once

#include "holdfast/export.h"
#include "holdfast/types.h"

namespace holdfast {

/// Gives the facets without a marker (all, or those of 0) one for each smooth patch, the first free numbers
/// from 1: patches are joined across edges of exactly two such facets whose normals differ by less than
/// `degrees`. Vertices with identical coordinates are one. A facet without a normal goes with its neighbour
/// at its longest edge. Returns how many patches there are; 0 where every facet has a marker. Throws
/// std::invalid_argument unless `degrees` is from 0 to 180, and std::out_of_range for indices of no vertex.
HOLDFAST_API std::size_t markers_by_angle(Surface& surface, double degrees);

}  // namespace holdfast
