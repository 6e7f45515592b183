// Triangulations of an edge's link that make nothing bad.
#pragma once

#include <algorithm>
#include <optional>

#include "mesh/edge_removal.h"
#include "mesh/quality_below.h"
#include "mesh/tet_mesh.h"
#include "optimise/badness.h"

namespace holdfast {

/// An objective for LinkTriangulation: the least worst Q, which is below `bad_from`, and no new edge at one
/// vertex.
class NothingBad {
 public:
  using Cost = double;  // the worst Q

  NothingBad(const TetMesh& mesh, const EdgeShell& shell, double bad_from, Vertex avoided = kNone)
      : mesh_(mesh), shell_(shell), bad_from_(bad_from), avoided_(avoided) {}

  static Cost none() { return 0; }
  static Cost join(Cost x, Cost y) { return std::max(x, y); }
  static bool better(Cost x, Cost y) { return x < y; }
  static Cost diagonal(std::size_t, std::size_t) { return 0; }
  [[nodiscard]] std::optional<Cost> triangle(std::size_t i, std::size_t k, std::size_t j) const {
    const Vertex pi = shell_.link[i], pk = shell_.link[k], pj = shell_.link[j];
    const std::size_t n = shell_.size();
    const auto is_new_at_avoided = [&](std::size_t u, std::size_t v) {
      return (v - u != 1 && v - u != n - 1) && (shell_.link[u] == avoided_ || shell_.link[v] == avoided_);
    };
    if (is_new_at_avoided(i, k) || is_new_at_avoided(k, j) || is_new_at_avoided(i, j)) return std::nullopt;
    if (!sees_both_ends(mesh_, shell_, i, k, j)) return std::nullopt;
    const auto below = [&](Vertex u, Vertex v, Vertex w, Vertex end) {
      return quality_below(mesh_.position(u), mesh_.position(v), mesh_.position(w), mesh_.position(end),
                           bad_from_);
    };
    const std::optional<Cost> at_b = below(pi, pk, pj, shell_.b);
    if (!at_b) return std::nullopt;
    const std::optional<Cost> at_a = below(pj, pk, pi, shell_.a);
    return at_a ? std::optional(std::max(*at_b, *at_a)) : std::nullopt;
  }

 private:
  const TetMesh& mesh_;
  const EdgeShell& shell_;
  const double bad_from_;
  const Vertex avoided_;
};

}  // namespace holdfast
