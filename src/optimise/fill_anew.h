// For the worst elements and for points, when no local change helps: a polyhedron of tetrahedra round one is
// treated as a surface and filled by the whole pipeline, which begins with a Delaunay mesh of its vertices.
#pragma once

#include "optimise/search.h"

namespace holdfast {

/// Fills polyhedra round points anew. A filling without the point replaces the polyhedron if it is no worse
/// than the whole mesh.
void fill_anew_without_points(Search& search, const FillAnew& how);

/// Fills polyhedra round the worst elements anew as long as that betters these: no more points for it than
/// they are worth.
void fill_anew_round_the_worst(Search& search, const FillAnew& how);

}  // namespace holdfast
