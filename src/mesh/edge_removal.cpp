#include "mesh/edge_removal.h"

#include <algorithm>
#include <cassert>
#include <span>

#include "mesh/editor.h"

namespace holdfast {
namespace {

// What stays of a shell: its outer faces, and which of them and of their edges are constraints.
class ShellBoundary {
 public:
  ShellBoundary(const TetMesh& mesh, const EdgeShell& shell) {
    for (std::size_t i = 0; i < shell.size(); ++i) {
      const Tet t = shell.tets[i];
      const int a = mesh.index_of(t, shell.a), b = mesh.index_of(t, shell.b),
                p = mesh.index_of(t, shell.link[i]), q = 6 - a - b - p;
      at_[0][i] = {mesh.neighbour(t, b), mesh.is_facet(face_code(t, b)), is_segment(mesh, t, a, p)};
      at_[1][i] = {mesh.neighbour(t, a), mesh.is_facet(face_code(t, a)), is_segment(mesh, t, b, p)};
      side_[i] = is_segment(mesh, t, p, q);
    }
  }

  /// Of the outer face at a (end 0) or b (end 1) and side i of the link, from corner i to the next.
  [[nodiscard]] Face across(std::size_t end, std::size_t i) const { return at_[end][i].across; }
  [[nodiscard]] bool is_facet(std::size_t end, std::size_t i) const { return at_[end][i].is_facet; }
  /// Whether the edge from that end to corner i is a segment, or side i.
  [[nodiscard]] bool is_spoke_segment(std::size_t end, std::size_t i) const { return at_[end][i].is_segment; }
  [[nodiscard]] bool is_side_segment(std::size_t i) const { return side_[i]; }

 private:
  static bool is_segment(const TetMesh& mesh, Tet t, int u, int v) {
    return mesh.is_segment(t, kEdgeOf[static_cast<std::size_t>(u)][static_cast<std::size_t>(v)]);
  }

  struct AtEnd {
    Face across;
    bool is_facet, is_segment;
  };
  std::array<std::array<AtEnd, kMostLink>, 2> at_;
  std::array<bool, kMostLink> side_;
};

// Joins the two tetrahedra of each link triangle to each other, to those of the triangles beside it and to
// what lies across the shell's outer faces.
class ShellFilling {
 public:
  ShellFilling(MeshEditor& editor, const ShellBoundary& boundary, std::size_t size)
      : editor_(editor), boundary_(boundary), n_(size) {
    for (std::size_t i = 0; i < n_; ++i) std::fill_n(open_[i].begin(), n_, std::array<Face, 2>{kNone, kNone});
  }

  /// The triangle's tetrahedra are (p_j p_k p_i a) and (p_i p_k p_j b).
  void join(const LinkTriangle& triangle, const std::array<Tet, 2>& tets) {
    editor_.link(face_code(tets[0], 3), face_code(tets[1], 3));
    const auto [i, k, j] = triangle;
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

 private:
  // The face opposite corner `c`, which has the corners x < y of the link.
  void join_side(std::size_t end, Tet t, std::size_t x, std::size_t y, int c) {
    const Face face = face_code(t, c);
    const bool closes = x == 0 && y + 1 == n_;
    if (!closes && y != x + 1) {
      Face& other = open_[x][y][end];
      if (other != kNone) editor_.link(face, other);
      other = face;
      return;
    }
    const std::size_t side = closes ? y : x;
    editor_.link(face, boundary_.across(end, side));
    if (boundary_.is_facet(end, side)) editor_.set_flags(t, facet_bit(c));
    // The two other corners of the link triangle.
    const std::size_t u = c == 0 ? 1 : 0, v = c == 2 ? 1 : 2;
    if (boundary_.is_side_segment(side)) editor_.set_flags(t, segment_bit(kEdgeOf[u][v]));
  }

  void set_spoke(std::size_t end, Tet t, std::size_t corner, int c) {
    if (boundary_.is_spoke_segment(end, corner))
      editor_.set_flags(t, segment_bit(kEdgeOf[static_cast<std::size_t>(c)][3]));
  }

  MeshEditor& editor_;
  const ShellBoundary& boundary_;
  const std::size_t n_;
  // At each end, the face at a diagonal that has no neighbour yet.
  std::array<std::array<std::array<Face, 2>, kMostLink>, kMostLink> open_;
};

}  // namespace

bool gather_shell(const TetMesh& mesh, Tet t, Vertex a, Vertex b, EdgeShell& out, std::size_t most) {
  out.a = a;
  out.b = b;
  out.tets.clear();
  out.link.clear();
  const Tet start = t;
  do {
    if (out.tets.size() == most || mesh.is_ghost(t)) return false;
    const auto& cd = kOpposite[static_cast<std::size_t>(mesh.index_of(t, a))]
                              [static_cast<std::size_t>(mesh.index_of(t, b))];
    out.tets.push_back(t);
    out.link.push_back(mesh.corner(t, cd[0]));
    t = tet_of(mesh.neighbour(t, cd[0]));
  } while (t != start);
  return true;
}

void tetrahedra_of(const EdgeShell& shell, const std::vector<LinkTriangle>& triangles,
                   std::vector<TetMesh::Corners>& out) {
  for (const auto& [i, k, j] : triangles) {
    const Vertex pi = shell.link[i], pk = shell.link[k], pj = shell.link[j];
    out.push_back({pi, pk, pj, shell.b});
    out.push_back({pj, pk, pi, shell.a});
  }
}

void replace_shell(TetMesh& mesh, const EdgeShell& shell, const std::vector<LinkTriangle>& triangles,
                   std::vector<Tet>* created) {
  assert(shell.size() <= kMostLink && triangles.size() + 2 == shell.size());
  const ShellBoundary boundary(mesh, shell);
  MeshEditor editor(mesh);
  for (const Tet t : shell.tets) editor.remove_tet(t);
  ShellFilling filling(editor, boundary, shell.size());
  std::vector<Tet> local;
  std::vector<Tet>& tets = created != nullptr ? *created : local;
  const std::size_t first = tets.size();
  const auto add = [&](const TetMesh::Corners& corners) {
    const Tet t = editor.add_tet(corners);
    tets.push_back(t);
    for (const Vertex v : corners) editor.set_incident(v, t);
    return t;
  };
  for (const LinkTriangle& triangle : triangles) {
    const auto [i, k, j] = triangle;
    const Vertex pi = shell.link[i], pk = shell.link[k], pj = shell.link[j];
    const Tet at_b = add({pi, pk, pj, shell.b}), at_a = add({pj, pk, pi, shell.a});
    filling.join(triangle, {at_a, at_b});
  }
  editor.finish(std::span(tets).subspan(first));
}

}  // namespace holdfast
