// Edge removal: the shell of an edge re-triangulated without it, the best way (n tetrahedra become 2n-4).
//
//                b                The shell of edge ab is a ring of tetrahedra (a b p_i p_i+1); its link
//              / | \              is the polygon p_0 .. p_n-1. Any triangulation of the polygon whose
//             /  |  \             triangles (p_i p_k p_j), i < k < j, see b above and a below gives the
//        p_0 -------- p_3         2(n-2) tetrahedra (p_i p_k p_j b) and (p_j p_k p_i a) that fill the
//           \ \  |  /  \          same space: they are positive and have the shell's boundary.
//            \  \|/     \         n = 3 is the 3-2 flip, n = 4 the 4-4 flip.
//           p_1 -|----- p_2
//             \  |   /            The best triangulation is found by dynamic programming over the
//               \| /              polygon's diagonals in O(n^3): Klincsek 1980; Freitag, Ollivier-Gooch
//                a                1997; Shewchuk 2002, "Two discrete optimization algorithms".
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "mesh/tet_mesh.h"

namespace holdfast {

/// Links above this size are not triangulated: the time grows with the cube.
inline constexpr std::size_t kMostLink = 20;

/// The tetrahedra round an edge and the polygon of their other vertices.
struct EdgeShell {
  Vertex a = kNone, b = kNone;
  std::vector<Tet> tets;     ///< tets[i] holds link[i] and link[i + 1]
  std::vector<Vertex> link;  ///< orient(a, b, link[i], link[i + 1]) > 0

  [[nodiscard]] std::size_t size() const { return link.size(); }
};

/// Gathers the tetrahedra round edge ab, of any mesh that has `corners` and `index_of`, from t on. Beyond the
/// face opposite corner i of one comes `across(t, i)`; where that is kNone, or there are more than `most`, it
/// returns false, with `out` unspecified.
template <typename Mesh, typename Across>
bool gather_round(const Mesh& mesh, Tet t, Vertex a, Vertex b, EdgeShell& out, std::size_t most,
                  Across&& across) {
  out.a = a;
  out.b = b;
  out.tets.clear();
  out.link.clear();
  const Tet start = t;
  int c = opposite_corners(mesh.index_of(t, a), mesh.index_of(t, b))[0];
  Vertex p = mesh.corners(t)[static_cast<std::size_t>(c)];
  while (true) {
    if (out.tets.size() == most) return false;
    out.tets.push_back(t);
    out.link.push_back(p);
    // The fourth corner, of the face that comes next.
    const auto& v = mesh.corners(t);
    p ^= v[0] ^ v[1] ^ v[2] ^ v[3] ^ a ^ b;
    t = across(t, c);
    if (t == kNone) return false;
    if (t == start) return true;
    c = mesh.index_of(t, p);
  }
}

/// Gathers the shell of edge ab of tetrahedron t. Returns false, with `out` unspecified, where the edge
/// is on the hull or has more than `most` tetrahedra.
bool gather_shell(const TetMesh& mesh, Tet t, Vertex a, Vertex b, EdgeShell& out,
                  std::size_t most = kMostLink);

/// A triangle of the link polygon as positions in the link, i < k < j.
using LinkTriangle = std::array<std::uint8_t, 3>;

/// The best triangulation of link polygons with n <= kMostLink corners; keeps its tables between calls.
///
/// An Objective for this Cost has
///   Cost none() const                                  the cost of nothing
///   Cost join(Cost, Cost) const                        associative; never better than its arguments
///   bool better(Cost, Cost) const                      a strict order
///   std::optional<Cost> triangle(i, k, j)              i < k < j; nothing for a forbidden triangle
///   Cost diagonal(i, j)                                i < j, an edge that the triangulation adds
/// Equal costs: the first found stays.
template <typename Cost>
class LinkTriangulation {
 public:
  /// The cost of the best triangulation, or nothing where there is none.
  template <typename Objective>
  std::optional<Cost> find(std::size_t n, Objective& objective) {
    for (std::size_t i = 0; i + 1 < n; ++i) {
      best_[i][i + 1] = {objective.none(), 0};
      to_[i] = bit(i + 1);
      from_[i + 1] = bit(i);
    }
    for (std::size_t gap = 2; gap < n; ++gap)
      for (std::size_t i = 0; i + gap < n; ++i) fill(i, i + gap, i != 0 || gap + 1 != n, objective);
    if ((to_[0] & bit(n - 1)) == 0) return std::nullopt;
    return best_[0][n - 1].cost;
  }

  /// The n - 2 triangles of the triangulation found last, appended.
  void triangles(std::size_t n, std::vector<LinkTriangle>& out) const { collect(0, n - 1, out); }

 private:
  struct Entry {
    Cost cost{};
    std::uint8_t apex = 0;
  };
  using Corners = std::uint32_t;  // one bit each
  static constexpr Corners bit(std::size_t i) { return Corners{1} << i; }

  // The best triangulation of the polygon p_i .. p_j, diagonal (i, j) included unless it is a side.
  template <typename Objective>
  void fill(std::size_t i, std::size_t j, bool is_diagonal, Objective& objective) {
    Entry found;
    bool exists = false;
    for (Corners apexes = to_[i] & from_[j]; apexes != 0; apexes &= apexes - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(apexes));
      const Cost parts = objective.join(best_[i][k].cost, best_[k][j].cost);
      if (exists && !objective.better(parts, found.cost)) continue;
      const std::optional<Cost> triangle = objective.triangle(i, k, j);
      if (!triangle) continue;
      const Cost cost = objective.join(parts, *triangle);
      if (exists && !objective.better(cost, found.cost)) continue;
      found = {cost, static_cast<std::uint8_t>(k)};
      exists = true;
    }
    if (!exists) return;
    if (is_diagonal) found.cost = objective.join(found.cost, objective.diagonal(i, j));
    best_[i][j] = found;
    to_[i] |= bit(j);
    from_[j] |= bit(i);
  }

  void collect(std::size_t i, std::size_t j, std::vector<LinkTriangle>& out) const {
    if (j - i < 2) return;
    const std::size_t k = best_[i][j].apex;
    out.push_back({static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(k), static_cast<std::uint8_t>(j)});
    collect(i, k, out);
    collect(k, j, out);
  }

  std::array<std::array<Entry, kMostLink>, kMostLink> best_;
  // By corner i, the corners k for which there is a triangulation of p_i .. p_k, or of p_k .. p_i.
  std::array<Corners, kMostLink> to_, from_;
};

/// Whether a link triangle's two tetrahedra are strictly positive.
[[nodiscard]] inline bool sees_both_ends(const TetMesh& mesh, const EdgeShell& shell, std::size_t i,
                                         std::size_t k, std::size_t j) {
  const Vertex pi = shell.link[i], pk = shell.link[k], pj = shell.link[j];
  const auto [of_a, of_b] = mesh.orient_both(pi, pk, pj, shell.a, shell.b);
  return of_a < 0 && of_b > 0;
}

/// The new tetrahedra of a triangulated link, appended.
void tetrahedra_of(const EdgeShell& shell, const std::vector<LinkTriangle>& triangles,
                   std::vector<TetMesh::Corners>& out);

}  // namespace holdfast
