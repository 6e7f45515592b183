// Elimination of a point from a constraint by cut and cone (paper §5.3, §6.3; docs/concepts.md).
//
//   The link of P is cut along the polygons of the constraints through P, which leaves sectors; each
//   polygon is triangulated again without P; each sector is coned to an apex of its own, an existing
//   vertex of the sector that sees everything else, or a new point of the sector's kernel:
//
//           .-----.                    .-----.
//          / \   / \ .                /   P1  \ .
//        r0 -- P -- r1   facet F     r0 ------- r1   F is covered without P;
//          \ / \ / .                  \   P2  / .     P1 and P2 are off it
//           '-----'                    '-----'
//
//   Two polygons bound a sector round a segment's point, one a half-ball at a facet's point. All outer
//   faces of a sector see P strictly, hence a small open set next to P inside the sector: the kernel is
//   open and not empty, and the elimination always succeeds in exact arithmetic.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "mesh/tet_mesh.h"

namespace holdfast {

/// Takes P, which lies inside a facet or inside a segment, off its constraint.
///
/// `ends`: P's neighbours A', B' on its segment's chain, none for a point inside a facet. The facet and
/// segment bits of the mesh say where the constraints are; afterwards A'B' is a segment edge and P is
/// gone. A segment with fewer than two facets is cut along fictitious polygons too (fictitious_cut.h).
/// Returns the new vertices (Steiner points strictly off every constraint that stands).
std::vector<Vertex> cut_and_cone(TetMesh& mesh, Vertex p, std::optional<std::array<Vertex, 2>> ends);

}  // namespace holdfast
