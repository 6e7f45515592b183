// Balls, shells and look-ups, used by every stage.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/tet_mesh.h"

namespace holdfast {

/// Tetrahedra at v (ghosts included), appended to `out`. The mesh's visited bits serve as scratch.
void ball(TetMesh& mesh, Vertex v, std::vector<Tet>& out);

/// The same without the visited bits, for threads that change parts of the mesh (in_place_parts.h). Slower.
void ball_without_marks(const TetMesh& mesh, Vertex v, std::vector<Tet>& out);

/// The vertices of v's link in ascending order, without the ghost.
[[nodiscard]] std::vector<Vertex> link_vertices(TetMesh& mesh, Vertex v);

/// The shell of edge ab, starting with t, turning from the face (a b c) to (a b d) where
/// (a b c d) is an even permutation of t's corners. Appended to `out`.
void shell(const TetMesh& mesh, Tet t, Vertex a, Vertex b, std::vector<Tet>& out);

/// A tetrahedron that holds edge ab, or kNone.
[[nodiscard]] Tet find_edge(TetMesh& mesh, Vertex a, Vertex b);

/// The face abc (one of its two codes), or kNone.
[[nodiscard]] Face find_face(TetMesh& mesh, Vertex a, Vertex b, Vertex c);
/// The same, searched in the shell of edge ab of tetrahedron t.
[[nodiscard]] Face find_face_round(const TetMesh& mesh, Tet t, Vertex a, Vertex b, Vertex c);

/// The tetrahedron that holds v, inside or on its boundary, or the ghost beyond which v lies, found by a walk
/// from `start`; kNone if the walk takes too long. The mesh need not be Delaunay: the random order of the
/// faces makes the walk arrive nearly always (Devillers, Pion, Teillaud 2002). `random` is its state.
[[nodiscard]] Tet walk_to(const TetMesh& mesh, Vertex v, Tet start, std::uint32_t& random);

}  // namespace holdfast
