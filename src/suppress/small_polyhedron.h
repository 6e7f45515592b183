// Small polyhedron reconnection: tetrahedra without new points for a small cavity, by branch and bound
// (Liu, Chen, Chen 2007; Marot, Remacle 2020).
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "mesh/quality.h"
#include "mesh/tet_mesh.h"

namespace holdfast {

struct PolyhedronOptions {
  using Measure = double (*)(const Point&, const Point&, const Point&, const Point&);

  std::size_t most_vertices = 18;                                  ///< 31 at most
  std::size_t most_nodes = 600;                                    ///< of the search tree
  double worst_quality = std::numeric_limits<double>::infinity();  ///< Q (mesh/quality.h) stays below this
  Measure measure = quality;                                       ///< or whatever this is
};

/// Fills a polyhedron with strictly positive tetrahedra on its own vertices. Its faces are given so that a
/// point x inside sees them with orient(f0, f1, f2, x) > 0.
///
/// Positive tetrahedra whose faces, as oriented chains, cancel in pairs except for the polyhedron's own cover
/// every point as often as the boundary winds round it, that is once inside and never outside: no
/// intersection test is needed. Returns nothing when the search ends, or its budget does, without one.
[[nodiscard]] std::optional<std::vector<TetMesh::Corners>> fill_polyhedron(
    const TetMesh& mesh, std::span<const std::array<Vertex, 3>> faces, const PolyhedronOptions& options = {});

/// Whether the search ends, within its budget, without one: then there is none of that quality.
[[nodiscard]] bool is_unfillable(const TetMesh& mesh, std::span<const std::array<Vertex, 3>> faces,
                                 const PolyhedronOptions& options = {});

}  // namespace holdfast
