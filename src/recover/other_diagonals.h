// Finds facets that are missing only because the mesh has the other diagonal of a plane quadrilateral, as
// happens by chance in Delaunay meshes of grids. Such facets need no test of whether they fit together with
// standing constraints.
#pragma once

#include "mesh/tet_mesh.h"
#include "recover/standing.h"
#include "surface/complex.h"

namespace holdfast {

/// `standing`, with such facets and their common side added: two facets abc and abd of a plane, of which only
/// ab is missing, where the mesh has the faces cda and cdb, cd is no segment, and no other such pair has the
/// same cd. All elements with a flag in the result, those of `standing` included, meet in common faces or not
/// at all (docs/decisions/validation-other-diagonals-fit-too.md).
///
/// `standing` must be as mark_present says; no two vertices of `complex` may be the same.
[[nodiscard]] Standing with_other_diagonals(TetMesh& mesh, const Complex& complex, const SegmentTable& table,
                                            const Standing& standing);

}  // namespace holdfast
