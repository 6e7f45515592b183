// For the worst elements and for points, when nothing helps in the mesh as it is: a polyhedron of tetrahedra
// round one is taken for a surface and filled by the whole pipeline, which begins with a Delaunay mesh of its
// vertices.
#pragma once

#include "optimise/search.h"

namespace holdfast {

/// Fills polyhedra round points anew: what comes without them, and is no worse than the whole, takes their
/// place.
void fill_anew_without_points(Search& search, const FillAnew& how);

/// Fills polyhedra round the worst elements anew as long as that betters these: no more points for it than
/// they are worth.
void fill_anew_round_the_worst(Search& search, const FillAnew& how);

}  // namespace holdfast
