// Delaunay tetrahedralisation of the vertices of a mesh (paper §5.1).
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "mesh/monitor.h"
#include "mesh/parallel.h"
#include "mesh/tet_mesh.h"

namespace holdfast {

struct DelaunayOrder {
  std::uint64_t seed = 1;  ///< of the insertion order
  Threads threads = 1;     ///< the result does not depend on them
};

/// Triangulates all vertices of a mesh that has no tetrahedra yet. Every vertex must be explicit and
/// finite.
///
/// Afterwards every tetrahedron is strictly positive and no vertex lies strictly inside its sphere;
/// ghosts (kGhost in slot 3) stand on the hull faces, so that every face has a neighbour; a ghost's
/// first three corners turn so that a point d beyond the hull face has orient(v0, v1, v2, d) > 0.
/// Of equal points the first is used, the others keep incident() == kNone.
///
/// Returns false, with no tetrahedra made, if all vertices are coplanar (or fewer than four).
/// Throws Interrupted through the monitor, which may be null, and std::length_error beyond 2^30 vertices
/// or tetrahedra; the mesh then has no tetrahedra.
bool build_delaunay(TetMesh& mesh, const DelaunayOrder& options, Monitor* monitor);

/// Delaunay tetrahedra of points that are finite; none if all are coplanar. `progress` may throw.
[[nodiscard]] std::vector<Tetrahedron> delaunay_of(std::span<const Point> points, std::uint64_t seed,
                                                   const Threads& threads,
                                                   const std::function<void(double)>& progress);

}  // namespace holdfast
