// The one way to change the mesh: TetMesh gives its mutators to nobody else.
//
// An operation opens an editor, plans while the mesh is still whole, applies with the steps below, which
// cannot fail, and finishes. Between the first step and finish() the invariants of tet_mesh.h need not hold;
// finish() is where the validator stands. The operations are
//   replace, replace_shell, swap_face     a cavity, the shell of an edge, a face (replace.h, edge_removal.h,
//                                         face_swap.h)
//   PointCavity::insert                   the star of a new point
//   Parts, cut_parts                      parts cut out and joined
//   load, renumber                        the whole mesh
//   move_vertex, set_facet, set_segment   one vertex, one constraint
// and tests/layers.py holds the list of the files that take single steps.
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "mesh/tet_mesh.h"
#include "mesh/validate.h"

namespace holdfast {

class MeshEditor {
 public:
  explicit MeshEditor(TetMesh& mesh) : mesh_(mesh) {}

  // --- whole operations
  /// All tetrahedra of a mesh that had none, at once. The two arrays are as long as each other and satisfy
  /// the invariants once the operation is finished; flags are cleared and incident tetrahedra set here.
  void load(std::vector<TetMesh::Corners> corners, std::vector<TetMesh::Neighbours> neighbours) {
    mesh_.set_tets(std::move(corners), std::move(neighbours));
  }
  /// New numbers for all tetrahedra and for the vertices from `first` on: `tets` lists the living ones, and
  /// `vertices` those vertices, in their new order. Free slots go.
  void renumber(std::span<const Tet> tets, Vertex first, std::span<const Vertex> vertices) {
    mesh_.renumber(tets, first, vertices);
    finish();
  }
  /// Moves a vertex inside the kernel of its ball.
  void move_vertex(Vertex v, const Point& p) {
    mesh_.move_vertex(v, p);
    finish_move(v);
  }
  void move_vertex(Vertex v, const exact::ExactPoint& p) {
    mesh_.move_vertex(v, p);
    finish_move(v);
  }
  /// Marks a face on both sides.
  void set_facet(Face f) {
    mesh_.set_facet(f);
    finish(std::array{tet_of(f), tet_of(mesh_.neighbour(f))});
  }

  // --- steps of an operation
  Tet add_tet(const TetMesh::Corners& v) { return mesh_.add_tet(v); }
  void remove_tet(Tet t) { mesh_.remove_tet(t); }
  void link(Face f, Face g) { mesh_.link(f, g); }
  void set_flags(Tet t, Flags f) { mesh_.set_flags(t, f); }
  void clear_flags(Tet t, Flags f) { mesh_.clear_flags(t, f); }
  void set_incident(Vertex v, Tet t) { mesh_.set_incident(v, t); }
  /// The position of a vertex whose ball is not yet, or no longer, as it will be when the operation is done.
  void place_vertex(Vertex v, const Point& p) { mesh_.move_vertex(v, p); }
  /// Slots for `count` more tetrahedra, one after another, that put_tet fills. Returns the first.
  Tet add_slots(std::size_t count) { return mesh_.add_slots(count); }
  /// Fills a slot that is not free. Threads may fill different slots at the same time.
  void put_tet(Tet t, const TetMesh::Corners& v, const TetMesh::Neighbours& n, Flags f) {
    mesh_.put_tet(t, v, n, f);
  }

  // Where the validator stands in builds with HOLDFAST_VALIDATE: it throws std::logic_error.
  /// The operation is done, and these are the tetrahedra that it made or changed.
  void finish(std::span<const Tet> changed) const {
    if constexpr (kValidates) throw_on_fault(mesh_, changed);
  }
  /// The operation is done, and it changed the whole mesh.
  void finish() const {
    if constexpr (kValidates) throw_on_fault(mesh_);
  }

 private:
#ifdef HOLDFAST_VALIDATE
  static constexpr bool kValidates = true;
#else
  static constexpr bool kValidates = false;
#endif

  void finish_move(Vertex v) {
    if constexpr (kValidates) throw_on_fault_round(v);
  }
  void throw_on_fault_round(Vertex v);

  TetMesh& mesh_;
};

}  // namespace holdfast
