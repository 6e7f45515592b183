// The ten exchanges at a tetrahedron: the removal of one of its six edges (3-2, 4-4, n to 2n-4;
// edge_removal.h) or the swap of one of its four faces (2-3; face_swap.h). One enumeration for every
// objective.
//
// Of equal exchanges the one met first stays, edges before faces, each in the order of their numbers.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "mesh/edge_removal.h"
#include "mesh/tet_mesh.h"

namespace holdfast {

/// A face between two tetrahedra that may give way to the edge between their apexes.
struct SharedFace {
  std::array<Tet, 2> tets{};
  std::array<Vertex, 3> v{};  ///< seen positively from `top`, the apex of the first
  Vertex top = kNone, bottom = kNone;
};

/// The tetrahedra that go and those that come.
struct Exchange {
  bool removes_edge = false;
  EdgeShell shell;  ///< of the edge, and the triangulation of its link
  std::vector<LinkTriangle> triangles;
  std::vector<Tet> old_tets;
  std::vector<TetMesh::Corners> new_tets;
};

/// `created` receives the tetrahedra that come.
void make(TetMesh& mesh, const Exchange& exchange, std::vector<Tet>& created);

/// What the exchanges in a TetMesh are, for objectives to inherit from. Larger shells hardly ever pay, and
/// cost their cube.
class ExchangesInMesh {
 public:
  ExchangesInMesh(const TetMesh& mesh, std::size_t most_shell) : mesh_(mesh), most_shell_(most_shell) {}

  bool gather_edge(Tet t, int edge, EdgeShell& out) const {
    // A facet round the edge would have it for a side, so only segments are in the way.
    if (mesh_.is_segment(t, edge)) return false;
    const auto [a, b] = ends_of_edge(mesh_.corners(t), edge);
    return gather_shell(mesh_, t, a, b, out, most_shell_);
  }
  bool gather_face(Tet t, int side, SharedFace& out) const {
    const Face f = face_code(t, side), g = mesh_.neighbour(f);
    if (mesh_.is_facet(f) || mesh_.is_ghost(tet_of(g))) return false;
    out = {{t, tet_of(g)}, mesh_.face_vertices(f), mesh_.apex(f), mesh_.apex(g)};
    return true;
  }
  static TetMesh::Corners beside(const SharedFace& f, std::size_t k) {
    return {f.bottom, f.v[k], f.v[(k + 1) % 3], f.top};
  }

 protected:
  const TetMesh& mesh_;

 private:
  const std::size_t most_shell_;
};

/// The best exchange at a tetrahedron. An Objective has
///   Cost                                              of tetrahedra together
///   bool gather_edge(Tet, int edge, EdgeShell&)       the shell of an edge that may go
///   bool gather_face(Tet, int side, SharedFace&)      a face that may go
///   Corners beside(SharedFace, k)                     the new tetrahedron at side k of such a face, k < 3
///   std::optional<Cost> before(span<const Tet>)       of what goes; nothing where it must stay or cannot pay
///   link(shell, before)                               an objective for LinkTriangulation<Cost>
///   std::optional<Cost> after(three, before)          of what comes for a face; nothing if no better
///   bool gains(before, after)                         whether it pays, and more than the best so far
///   bool take(before, after, span<const Corners>)     the last, exact test; then this is the best so far
template <typename Objective>
class ExchangeSearch {
 public:
  using Cost = typename Objective::Cost;

  /// Null where none pays.
  [[nodiscard]] const Exchange* best_at(Tet t, Objective& objective) {
    found_ = false;
    for (int edge = 0; edge < 6; ++edge) try_edge(t, edge, objective);
    for (int side = 0; side < 4; ++side) try_face(t, side, objective);
    return found_ ? &best_ : nullptr;
  }

 private:
  void try_edge(Tet t, int edge, Objective& objective) {
    EdgeShell& shell = candidate_.shell;
    if (!objective.gather_edge(t, edge, shell)) return;
    const std::optional<Cost> before = objective.before(shell.tets);
    if (!before) return;
    auto link = objective.link(shell, *before);
    const std::optional<Cost> after = triangulation_.find(shell.size(), link);
    if (!after || !objective.gains(*before, *after)) return;
    candidate_.removes_edge = true;
    candidate_.triangles.clear();
    triangulation_.triangles(shell.size(), candidate_.triangles);
    candidate_.old_tets = shell.tets;
    candidate_.new_tets.clear();
    tetrahedra_of(shell, candidate_.triangles, candidate_.new_tets);
    offer(*before, *after, objective);
  }

  void try_face(Tet t, int side, Objective& objective) {
    SharedFace face;
    if (!objective.gather_face(t, side, face)) return;
    const std::optional<Cost> before = objective.before(face.tets);
    if (!before) return;
    const std::array<TetMesh::Corners, 3> three{objective.beside(face, 0), objective.beside(face, 1),
                                                objective.beside(face, 2)};
    const std::optional<Cost> after = objective.after(three, *before);
    if (!after || !objective.gains(*before, *after)) return;
    candidate_.removes_edge = false;
    candidate_.old_tets.assign(face.tets.begin(), face.tets.end());
    candidate_.new_tets.assign(three.begin(), three.end());
    offer(*before, *after, objective);
  }

  void offer(const Cost& before, const Cost& after, Objective& objective) {
    if (!objective.take(before, after, candidate_.new_tets)) return;
    std::swap(best_, candidate_);
    found_ = true;
  }

  // Kept, like the tables of the triangulation, to allocate nothing.
  Exchange best_, candidate_;
  LinkTriangulation<Cost> triangulation_;
  bool found_ = false;
};

}  // namespace holdfast
