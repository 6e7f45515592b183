// Puts several elements across every wall and gap, by levels (levels.h).
//
// Edges that jump over a level are parted at it. A point of level k is joined to the link of the edge that it
// parts, and no edge from it jumps over level k; so each parting leaves one edge less that does, and level
// after level, each half of the levels before its halves, comes to an end. Levels that are in order stay so:
// all of a tetrahedron is on one side of them. Edges of facets stay: vertices of the surface on a way of
// fewer edges along facets from a floor to a ceiling, as at the rim of a plate, have no level.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mesh/monitor.h"
#include "refine/levels.h"
#include "refine/volume_data.h"

namespace holdfast {

struct LayerStats {
  std::size_t points = 0;
  /// Edges that still jump over a level, for want of a place in doubles or as points for another direction
  /// made them; the middles of the first 100.
  std::size_t left = 0;
  std::vector<Point> places;
  std::size_t at_rims = 0;  ///< vertices of the surface on a way along facets of fewer edges
};

/// Parts edges of one region, `tets` its tetrahedra, until there are `layers` elements across, 2 or more; all
/// its vertices are explicit. Facets, segments and vertices stand. Regions, sizes and metrics are kept up to
/// date. `levels` are those of the region afterwards.
LayerStats make_layers(const VolumeData& volume, std::span<const Tet> tets, unsigned layers, Levels& levels,
                       Monitor& monitor);

}  // namespace holdfast
