// Triangulation of a plane polygon in space without new points (paper §2.1): ears, decided exactly.
#pragma once

#include <span>
#include <vector>

#include "mesh/tet_mesh.h"

namespace holdfast {

/// Cuts a simple polygon into triangles (v_i, v_j, v_k) that turn the way the polygon does. Its corners lie
/// in one plane and turn so that orient(p, q, r, above) > 0 for a triangle with positive area; `above` is
/// any vertex on that side. Corners may be collinear: an ear is never flat, and its closed triangle holds
/// no other corner. Among the possible ears the best shaped goes first.
///
/// Throws std::logic_error if the polygon is not simple.
[[nodiscard]] std::vector<std::array<Vertex, 3>> triangulate_polygon(const TetMesh& mesh,
                                                                     std::span<const Vertex> polygon,
                                                                     Vertex above);

}  // namespace holdfast
