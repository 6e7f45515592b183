// Holdfast: marks the smooth patches of a surface.
#pragma once

#include "holdfast/export.h"
#include "holdfast/types.h"

namespace holdfast {

/// Gives each smooth patch a marker, the first free numbers from 1. Only facets without a marker (all, or
/// those of marker 0) take part. Two of them belong to one patch if they alone share an edge and their
/// normals differ by less than `degrees`. Vertices with identical coordinates count as one. A facet without a
/// normal joins its neighbour at its longest edge. Returns the number of patches, 0 if every facet has a
/// marker. Throws std::invalid_argument unless `degrees` is from 0 to 180, and std::out_of_range for indices
/// of no vertex.
HOLDFAST_API std::size_t markers_by_angle(Surface& surface, double degrees);

}  // namespace holdfast
