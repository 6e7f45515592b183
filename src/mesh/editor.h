// The only way to change the mesh: TetMesh opens its mutators to no other class.
//
// Every operation is planned, checked and applied.
//   plan     is pure: while the mesh is whole it works out each new tetrahedron, with its neighbours and its
//            constraint bits (change.h).
//   check    The caller knows from exact signs that the new tetrahedra are positive. The plan of any
//            cavity also matches all faces, and throws with the mesh unchanged where they do not fit.
//   apply    cannot fail. In builds with HOLDFAST_VALIDATE it ends with the validator.
//
// Three kinds of cavity are so frequent that they have shorter plans, which match no faces since all
// neighbours are known beforehand. They leave the mesh that `replace` would leave, slot by slot:
//   replace          any cavity                                             cavity_plan.h
//   replace_shell    shell: the tetrahedra round an edge, without it        shell_plan.h
//   swap_face        face: two tetrahedra become three, round a new edge    face_plan.h
//   apply            star: a point and the faces that it sees               refine/point_cavity.h
#pragma once

#include <array>
#include <cassert>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "mesh/cavity_plan.h"
#include "mesh/change.h"
#include "mesh/edge_removal.h"
#include "mesh/slot_pools.h"
#include "mesh/tet_mesh.h"
#include "mesh/undo_log.h"

namespace holdfast {

class MeshEditor {
 public:
  explicit MeshEditor(TetMesh& mesh) : mesh_(mesh) {}

  // --- vertices in no tetrahedron
  void reserve(std::size_t vertices, std::size_t tets) { mesh_.reserve(vertices, tets); }
  void make_room(std::size_t vertices, std::size_t tets) { mesh_.make_room(vertices, tets); }
  /// From now on vertices only get doubles of this grid.
  void set_grid(const exact::DoubleGrid& grid) { mesh_.grid_ = grid; }
  /// A vertex at the point of the grid nearest to p.
  Vertex add_vertex(const Point& p) { return mesh_.add_vertex(p); }
  /// A vertex at an exact position; becomes explicit when the grid holds it.
  Vertex add_vertex(const exact::ExactPoint& p) {
    const Vertex v = mesh_.add_vertex(Point{});
    mesh_.move_vertex(v, p);
    return v;
  }
  Vertex add_vertex(const Position& place) {
    return std::visit([&](const auto& p) { return add_vertex(p); }, place);
  }
  /// Removes the position of a vertex that is in no tetrahedron.
  void remove_vertex(Vertex v) { mesh_.remove_vertex(v); }
  /// Takes back the vertex added last, which no tetrahedron may hold.
  void remove_last_vertex() { mesh_.remove_last_vertex(); }

  // --- tetrahedra
  /// Replaces a cavity. Throws std::logic_error, with the mesh unchanged, if the outer faces do not match.
  /// `created`, where given, receives the new tetrahedra in order. Vertices that lose their last tetrahedron
  /// have incident() == kNone afterwards.
  void replace(const Replacement& replacement, std::vector<Tet>* created = nullptr);
  /// Replaces the shell of an edge by the tetrahedra of its triangulated link, all positive. `created`, if
  /// given, receives the new tetrahedra in the order of tetrahedra_of. No constraint may be lost: the edge
  /// must not be a segment, and no face at it a facet.
  void replace_shell(const EdgeShell& shell, const std::vector<LinkTriangle>& triangles,
                     std::vector<Tet>* created = nullptr);
  /// Makes the 2-3 flip of a face that is not a facet. The three tetrahedra must be positive.
  std::array<Tet, 3> swap_face(Face f);
  /// Applies a planned change. `created` receives the new tetrahedra in order.
  void apply(const Change& change, std::vector<Tet>& created);

  // --- positions
  /// Moves a vertex inside the kernel of its ball, or anywhere if it is in no tetrahedron.
  void move_vertex(Vertex v, const Point& p) { move(v, p); }
  void move_vertex(Vertex v, const exact::ExactPoint& p) { move(v, p); }
  void move_vertex(Vertex v, const Position& place) {
    std::visit([&](const auto& p) { move(v, p); }, place);
  }
  /// Moves an explicit vertex, then calls `is_right()`, and moves the vertex back if that is false. `ball` is
  /// the ball of the vertex.
  template <typename Check>
  bool move_if(Vertex v, const Point& p, std::span<const Tet> ball, Check&& is_right) {
    const Point before = mesh_.position(v);
    mesh_.move_vertex(v, p);
    if (!is_right()) {
      mesh_.move_vertex(v, before);
      return false;
    }
    finish(ball);
    return true;
  }

  // --- constraints
  /// Marks a face on both sides.
  void set_facet(Face f);
  /// Marks edge ab of tetrahedron t in its whole shell as part of an input segment.
  void set_segment(Tet t, Vertex a, Vertex b);
  /// Remove the marks of a facet, or of a segment.
  void release_facet(Face f);
  void release_segment(Tet t, Vertex a, Vertex b);
  /// Marks constraints of one tetrahedron; threads may mark different ones at the same time. They are set
  /// from all sides when finish() is called.
  void mark_constraints(Tet t, Flags f) { mesh_.set_flags(t, f); }

  // --- the whole mesh
  /// All tetrahedra of a mesh that had none, at once. Flags are cleared and incident tetrahedra set here.
  void load(std::vector<TetMesh::Cell> cells) {
    set_tets(std::move(cells));
    finish();
  }
  /// New numbers for all tetrahedra and for the vertices from `first` on: `tets` lists the living ones, and
  /// `vertices` those vertices, in their new order. Free slots go.
  void renumber(std::span<const Tet> tets, Vertex first, std::span<const Vertex> vertices) {
    mesh_.renumber(tets, first, vertices);
    finish();
  }

  // --- taking back
  /// Sets the log that notes all changes from now on, or none. There is one log at a time.
  void note_in(UndoLog* log) {
    assert(log == nullptr || mesh_.attached_.log == nullptr);
    mesh_.attached_.log = log;
  }
  /// Undoes all changes that the log has noted since a mark.
  void undo(UndoLog& log, const UndoLog::Mark& mark);

  // --- parts that are changed at the same time (in_place_parts.h)
  /// From now on free slots come from these pools. The present free slots go into the pools, and each pool
  /// gets `spare` more slots if needed. No log may note changes.
  void share_slots(SlotPools& pools, std::size_t count, std::size_t spare);
  /// Returns the free slots to the mesh, and drops those at the end of the array.
  void unshare_slots();

  // --- where the validator stands in builds with HOLDFAST_VALIDATE: it throws std::logic_error
  /// The operation is done, and these are the tetrahedra that it made or changed.
  void finish(std::span<const Tet> changed) const {
    if constexpr (kValidates) throw_on_fault(changed);
  }
  /// The operation is done, and it changed the whole mesh.
  void finish() const {
    if constexpr (kValidates) throw_on_fault();
  }

 protected:
  // Single steps, during which the mesh need not be whole. MeshAssembly has them.
  void set_tets(std::vector<TetMesh::Cell> cells) { mesh_.set_tets(std::move(cells)); }
  void link(Face f, Face g) {
    mesh_.set_neighbour(f, g);
    mesh_.set_neighbour(g, f);
  }
  void set_flags(Tet t, Flags f) { mesh_.set_flags(t, f); }
  void clear_flags(Tet t, Flags f) { mesh_.clear_flags(t, f); }
  void set_incident(Vertex v, Tet t) { mesh_.set_incident(v, t); }
  void place_vertex(Vertex v, const Point& p) { mesh_.move_vertex(v, p); }
  Vertex add_vertices(std::size_t count) { return mesh_.add_vertices(count); }
  Tet add_tet(TetMesh::Corners v);
  void remove_tet(Tet t) { mesh_.remove_tet(t); }
  Tet add_slots(std::size_t count) { return mesh_.add_slots(count); }
  void put_tet(Tet t, const TetMesh::Corners& v, const TetMesh::Neighbours& n, Flags f) {
    mesh_.put_tet(t, v, n, f);
  }

 private:
#ifdef HOLDFAST_VALIDATE
  static constexpr bool kValidates = true;
#else
  static constexpr bool kValidates = false;
#endif
  void throw_on_fault(std::span<const Tet> changed) const;
  void throw_on_fault() const;

  template <typename Place>
  void move(Vertex v, const Place& p) {
    mesh_.move_vertex(v, p);
    if constexpr (kValidates) finish_ball(v);
  }
  void finish_ball(Vertex v);

  // Sets or clears the mark of a facet on both sides, or of a segment in the whole shell.
  using ChangeOfFlags = void (TetMesh::*)(Tet, Flags);
  void change_mark(Face f, ChangeOfFlags change);
  void change_mark(Tet t, Vertex a, Vertex b, ChangeOfFlags change);

  void put(const Change& change, std::span<Tet> slots);
  void undo_vertices(UndoLog& log, const UndoLog::Mark& mark);

  TetMesh& mesh_;
};

}  // namespace holdfast
