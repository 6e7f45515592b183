// Measures in floating point that guide a choice and never decide validity.
#pragma once

#include "mesh/kernel.h"
#include "mesh/tet_mesh.h"

namespace holdfast {

[[nodiscard]] Point centroid(const TetMesh& mesh, Tet t);

/// Six times the volume, approximately.
[[nodiscard]] double six_volumes(const TetMesh& mesh, const TetMesh::Corners& corners);

/// Distance of d from the plane abc, approximately.
[[nodiscard]] double height_over(const TetMesh& mesh, Vertex a, Vertex b, Vertex c, Vertex d);

/// Six times the volume over the cube of the longest edge, approximately; sqrt(2)/2 ... 0 from regular to
/// flat.
[[nodiscard]] double fatness(const TetMesh& mesh, Vertex a, Vertex b, Vertex c, exact::PointRef d);

/// The corner of the kernel's faces that sees all of them (exactly) and leaves the fattest thinnest
/// tetrahedron, or kNone.
[[nodiscard]] Vertex best_apex(const TetMesh& mesh, const Kernel& kernel);
/// The same among `candidates`.
[[nodiscard]] Vertex best_apex(const TetMesh& mesh, const Kernel& kernel, std::span<const Vertex> candidates);

}  // namespace holdfast
