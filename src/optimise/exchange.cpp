#include "optimise/exchange.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/replace.h"

namespace holdfast {
namespace {

constexpr std::size_t kMostShell = 12;  // larger shells hardly ever pay, and cost their cube

// Triangulations of a link by the badness of their tetrahedra, none with more flat ones than go.
class LeastBadness {
 public:
  using Cost = Badness;

  LeastBadness(const TetMesh& mesh, const EdgeShell& shell, const Badness& before, const BadFrom& bad_from)
      : mesh_(mesh), shell_(shell), before_(before), bad_from_(bad_from) {}

  static Cost none() { return {}; }
  static Cost join(const Cost& x, const Cost& y) { return holdfast::join(x, y); }
  static bool better(const Cost& x, const Cost& y) { return x < y; }
  static Cost diagonal(std::size_t, std::size_t) { return {}; }
  std::optional<Cost> triangle(std::size_t i, std::size_t k, std::size_t j) const {
    const Vertex pi = shell_.link[i], pk = shell_.link[k], pj = shell_.link[j];
    // The signs cost less than the exact quality of what is flat.
    if (!sees_both_ends(mesh_, shell_, i, k, j)) return std::nullopt;
    Badness both;
    both.add(quality_of(mesh_, {pi, pk, pj, shell_.b}), bad_from_);
    both.add(quality_of(mesh_, {pj, pk, pi, shell_.a}), bad_from_);
    if (!both.is_worthwhile_after(before_)) return std::nullopt;
    return both;
  }

 private:
  const TetMesh& mesh_;
  const EdgeShell& shell_;
  const Badness before_;
  const BadFrom& bad_from_;
};

}  // namespace

bool Exchanger::improve(Tet t, std::vector<Tet>& created) {
  way_ = Way::none;
  for (int edge = 0; edge < 6; ++edge) try_edge(t, edge);
  for (int side = 0; side < 4; ++side) try_face(face_code(t, side));
  if (way_ == Way::edge) replace_shell(mesh_, best_shell_, best_triangles_, &created);
  if (way_ == Way::face) replace(mesh_, {.old_tets = best_pair_, .new_tets = best_three_}, &created);
  return way_ != Way::none;
}

void Exchanger::try_edge(Tet t, int edge) {
  // A facet round the edge would have it for a side, so only segments are in the way.
  if (mesh_.is_segment(t, edge)) return;
  const auto& ends = kEdgeVertex[static_cast<std::size_t>(edge)];
  if (!gather_shell(mesh_, t, mesh_.corner(t, ends[0]), mesh_.corner(t, ends[1]), shell_, kMostShell)) return;
  const Badness before = qualities_.badness_of(shell_.tets, bad_from_);
  LeastBadness objective(mesh_, shell_, before, bad_from_);
  const std::optional<Badness> after = triangulation_.find(shell_.size(), objective);
  if (!after || !after->is_worthwhile_after(before) || !is_best(before, *after)) return;
  way_ = Way::edge;
  best_triangles_.clear();
  triangulation_.triangles(shell_.size(), best_triangles_);
  std::swap(best_shell_, shell_);
}

void Exchanger::try_face(Face f) {
  const Face g = mesh_.neighbour(f);
  if (mesh_.is_facet(f) || mesh_.is_ghost(tet_of(g))) return;
  const std::array<Tet, 2> both{tet_of(f), tet_of(g)};
  const Badness before = qualities_.badness_of(both, bad_from_);
  const std::array<Vertex, 3> v = mesh_.face_vertices(f);  // seen positively from the apex of f
  const Vertex top = mesh_.apex(f);
  const Vertex bottom = mesh_.apex(g);
  candidate_.clear();
  Badness after;
  for (std::size_t k = 0; k < 3; ++k) {
    const TetMesh::Corners tet{bottom, v[k], v[(k + 1) % 3], top};
    if (mesh_.orient(tet[0], tet[1], tet[2], tet[3]) <= 0) return;
    after.add(quality_of(mesh_, tet), bad_from_);
    if (!after.is_worthwhile_after(before)) return;
    candidate_.push_back(tet);
  }
  if (!is_best(before, after)) return;
  way_ = Way::face;
  best_pair_ = both;
  best_three_.swap(candidate_);
}

// Compared with those before; then it is the one to beat.
bool Exchanger::is_best(const Badness& before, const Badness& after) {
  const auto fewer = [](std::size_t x, std::size_t y) {
    return static_cast<std::ptrdiff_t>(y) - static_cast<std::ptrdiff_t>(x);
  };
  const Gain gain{fewer(before.null, after.null), fewer(before.hopeless, after.hopeless),
                  fewer(before.flat, after.flat), std::isinf(before.worst) ? 0 : after.worst / before.worst};
  if (way_ != Way::none && gain >= gain_) return false;
  gain_ = gain;
  return true;
}

}  // namespace holdfast
