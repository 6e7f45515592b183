// A true bound on the volume of every tetrahedron.
//
// Theorem. In exact arithmetic, finitely many points meet any positive bound, and leave every facet, segment
// and vertex as it is. Proof. The centroid of a tetrahedron lies strictly inside, and parts it into four of a
// quarter of the volume each. Give a tetrahedron of volume v the level 0 where v is within the bound b, else
// the least k with v <= b (4/3)^k. A point replaces a tetrahedron of a level above 0, and others, by finitely
// many of lower levels than its own: so what remains falls in the order of multisets (Dershowitz, Manna
// 1979), which has no infinite descent.
//
// A point that does this with better elements is preferred to the centroid: the centre of the sphere in the
// cavity that the in-sphere test gives, say, as long as every tetrahedron there is below three quarters of
// the one that was too large.
//
// A tetrahedron may contain no point in doubles that divides it. It is then only counted as stuck.
#pragma once

#include "mesh/monitor.h"
#include "refine/volume_data.h"
#include "size/size_function.h"

namespace holdfast {

struct BoundStats {
  std::size_t points = 0;
  std::size_t stuck = 0;  ///< tetrahedra above their bound that hold no point in doubles to part them
};

/// Adds points until no tetrahedron of the kept regions measures more than its region allows, exactly; all
/// their vertices are explicit. Facets, segments and vertices stand. Regions, sizes and metrics are kept up
/// to date.
BoundStats bound_volumes(const VolumeData& volume, Monitor& monitor);

/// Throws std::length_error where the bounds, or the user's sizes of regions or of a function, would take
/// more than 2^30 tetrahedra.
void require_few_enough(const VolumeData& volume, const SizeFunction& sizes);

struct RatioStats {
  std::size_t points = 0;
};

/// Adds points where they leave fewer tetrahedra of a ratio above `most` than there are: of the radius of the
/// sphere round a tetrahedron to its shortest edge. Each makes the number less, so there is an end. No
/// element becomes much flatter than those that go, or larger than its region allows.
RatioStats lower_ratios(const VolumeData& volume, double most, Monitor& monitor);

}  // namespace holdfast
