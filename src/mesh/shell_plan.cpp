#include "mesh/shell_plan.h"

#include <algorithm>
#include <cassert>

namespace holdfast {

ShellPlan::ShellPlan(const TetMesh& mesh, const EdgeShell& shell, const std::vector<LinkTriangle>& triangles)
    : shell_(shell) {
  assert(shell.size() <= kMostLink && triangles.size() + 2 == shell.size());
  read_shell(mesh);
  for (std::size_t i = 0; i < shell.size(); ++i)
    std::fill_n(open_[i].begin(), shell.size(), std::array<Face, 2>{kNone, kNone});
  for (std::size_t k = 0; k < triangles.size(); ++k) join(triangles[k], 2 * k);
}

void ShellPlan::read_shell(const TetMesh& mesh) {
  for (std::size_t i = 0; i < shell_.size(); ++i) {
    const Tet t = shell_.tets[i];
    const int a = mesh.index_of(t, shell_.a), b = mesh.index_of(t, shell_.b),
              p = mesh.index_of(t, shell_.link[i]), q = 6 - a - b - p;
    const auto at = [&](int end, int other) {
      return AtEnd{mesh.neighbour(t, other), mesh.is_facet(face_code(t, other)),
                   mesh.is_segment(t, edge_between(end, p))};
    };
    at_[0][i] = at(a, b);
    at_[1][i] = at(b, a);
    is_side_segment_[i] = mesh.is_segment(t, edge_between(p, q));
  }
}

// The two tetrahedra of a link triangle, in the order of tetrahedra_of: (p_i p_k p_j b) and (p_j p_k p_i a).
// They are joined to each other, to those of adjacent triangles, and to the tetrahedra across the shell's
// outer faces.
void ShellPlan::join(const LinkTriangle& triangle, std::size_t first) {
  const auto [i, k, j] = triangle;
  const Vertex pi = shell_.link[i], pk = shell_.link[k], pj = shell_.link[j];
  const std::array<std::size_t, 2> tets{first + 1, first};  // at a, at b
  new_tets_[tets[1]] = {{pi, pk, pj, shell_.b}, {kNone, kNone, kNone, new_face(tets[0], 3)}, 0};
  new_tets_[tets[0]] = {{pj, pk, pi, shell_.a}, {kNone, kNone, kNone, new_face(tets[1], 3)}, 0};
  for (std::size_t end = 0; end < 2; ++end) {
    // Corners of the tetrahedron at this end.
    const int of_i = end == 0 ? 2 : 0, of_k = 1, of_j = 2 - of_i;
    join_side(end, tets[end], i, k, of_j);
    join_side(end, tets[end], k, j, of_i);
    join_side(end, tets[end], i, j, of_k);
    set_spoke(end, tets[end], i, of_i);
    set_spoke(end, tets[end], k, of_k);
    set_spoke(end, tets[end], j, of_j);
  }
}

// The face opposite corner `c`; its corners x < y are in the link.
void ShellPlan::join_side(std::size_t end, std::size_t tet, std::size_t x, std::size_t y, int c) {
  const bool closes = x == 0 && y + 1 == shell_.size();
  if (!closes && y != x + 1) {
    Face& other = open_[x][y][end];
    if (other != kNone) {
      link(tet, c, other);
      link(number_of_new(other), side_of(other), new_face(tet, static_cast<std::size_t>(c)));
    }
    other = new_face(tet, static_cast<std::size_t>(c));
    return;
  }
  const std::size_t side = closes ? y : x;
  link(tet, c, at_[end][side].across);
  if (at_[end][side].is_facet) set_flag(tet, facet_bit(c));
  // The two other corners of the link triangle.
  if (is_side_segment_[side]) set_flag(tet, segment_bit(edge_between(c == 0 ? 1 : 0, c == 2 ? 1 : 2)));
}

void ShellPlan::set_spoke(std::size_t end, std::size_t tet, std::size_t corner, int c) {
  if (at_[end][corner].is_spoke_segment) set_flag(tet, segment_bit(edge_between(c, 3)));
}

void ShellPlan::link(std::size_t tet, int c, Face other) {
  new_tets_[tet].neighbours[static_cast<std::size_t>(c)] = other;
}

}  // namespace holdfast
