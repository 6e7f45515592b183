// Replacing a cavity: the one operation through which every stage after Delaunay changes the mesh (but for
// edge removal, which has a shorter way to the same: edge_removal.h).
//
// A flip, a split, a collapse, a cut-and-cone are all "these tetrahedra go, those come, and both fill
// the same space". The caller plans (pure, exact sign tests) and then applies; applying cannot fail
// for a plan whose new tetrahedra are all strictly positive and whose outer faces are the old ones.
#pragma once

#include <span>
#include <vector>

#include "mesh/tet_mesh.h"

namespace holdfast {

/// What goes and what comes. Constraint bits of faces and edges that stand before and after are kept;
/// `facets` and `segments` name those that come to stand inside the cavity.
struct Replacement {
  std::span<const Tet> old_tets;
  std::span<const TetMesh::Corners> new_tets;
  std::span<const std::array<Vertex, 3>> facets = {};
  std::span<const std::array<Vertex, 2>> segments = {};
};

/// Applies a replacement; `created`, where given, receives the new tetrahedra in order.
/// Vertices that lose their last tetrahedron have incident() == kNone afterwards.
///
/// Throws std::logic_error, with the mesh unchanged, if the outer faces do not match.
void replace(TetMesh& mesh, const Replacement& replacement, std::vector<Tet>* created = nullptr);

}  // namespace holdfast
