// The tetrahedral mesh: flat arrays, four vertices and four neighbours a tetrahedron.
//
// The shape follows the kernel of HXT (Marot, Pellerin, Remacle 2019): flat arrays indexed by
// tetrahedron, neighbour codes that name the shared face, ghost tetrahedra on the hull so that every
// face has a neighbour. 34 bytes a tetrahedron and 32 a vertex. Corners and neighbours of one lie together,
// so that a walk, which asks for both, waits for memory once a step.
//
// Invariants (validate.h checks them):
//   1. neighbour(neighbour(f)) == f, and both tetrahedra hold the same three vertices there;
//   2. every tetrahedron without a ghost is strictly positive, decided exactly;
//   3. a facet bit is set on both sides of a face, a segment bit in the whole shell of an edge;
//   4. incident(v) is a living tetrahedron that holds v, or kNone for a vertex that is not in the mesh.
//
// Only MeshEditor (editor.h) changes a mesh. All others may only read it and set the marks of searches.
#pragma once

#include <cstddef>
#include <span>
#include <variant>
#include <vector>

#include "exact/double_grid.h"
#include "exact/point.h"
#include "exact/predicates.h"
#include "holdfast/types.h"
#include "mesh/anatomy.h"

namespace holdfast {

class MeshEditor;
class SlotPools;
class UndoLog;

/// The place of a vertex: in doubles, or an exact position that doubles cannot represent.
using Position = std::variant<Point, exact::ExactPoint>;

class TetMesh {
 public:
  using Corners = std::array<Vertex, 4>;
  using Neighbours = std::array<Face, 4>;
  /// Half a cache line.
  struct alignas(32) Cell {
    Corners corners;
    Neighbours neighbours;
    friend bool operator==(const Cell&, const Cell&) = default;
  };

  // --- vertices
  /// Vertices only get doubles of this grid.
  [[nodiscard]] const exact::DoubleGrid& grid() const { return grid_; }
  /// The point of the grid nearest to p.
  [[nodiscard]] Point on_grid(const Point& p) const {
    return {grid_.nearest(p[0]), grid_.nearest(p[1]), grid_.nearest(p[2])};
  }
  [[nodiscard]] std::size_t vertex_count() const { return positions_.size(); }
  [[nodiscard]] bool is_explicit(Vertex v) const { return exact_of_[v] == kNone; }
  /// The position, or the doubles nearest to it.
  [[nodiscard]] const Point& position(Vertex v) const { return positions_[v]; }
  [[nodiscard]] std::span<const Point> positions() const { return positions_; }
  [[nodiscard]] exact::PointRef point(Vertex v) const {
    const std::uint32_t e = exact_of_[v];
    return {positions_[v].data(), e == kNone ? nullptr : &exact_[e]};
  }
  [[nodiscard]] exact::ExactPoint exact_position(Vertex v) const;
  [[nodiscard]] Tet incident(Vertex v) const { return incident_[v]; }
  [[nodiscard]] bool in_mesh(Vertex v) const { return incident_[v] != kNone; }

  // --- tetrahedra
  [[nodiscard]] std::size_t slot_count() const { return cells_.size(); }
  [[nodiscard]] std::size_t tet_count() const { return cells_.size() - free_.size(); }
  [[nodiscard]] bool alive(Tet t) const { return (flags_[t] & kDead) == 0; }
  [[nodiscard]] bool is_ghost(Tet t) const { return corners(t)[3] == kGhost; }
  [[nodiscard]] const Corners& corners(Tet t) const { return cells_[t].corners; }
  [[nodiscard]] const Neighbours& neighbours(Tet t) const { return cells_[t].neighbours; }
  [[nodiscard]] Vertex corner(Tet t, int i) const { return corners(t)[static_cast<std::size_t>(i)]; }
  [[nodiscard]] Face neighbour(Tet t, int i) const { return neighbours(t)[static_cast<std::size_t>(i)]; }
  [[nodiscard]] Face neighbour(Face f) const { return neighbour(tet_of(f), side_of(f)); }
  /// Prefetches t, or its neighbours.
  void prefetch(Tet t) const { __builtin_prefetch(&cells_[t]); }
  void prefetch_vertex(Vertex v) const { __builtin_prefetch(&positions_[v]); }
  void prefetch_neighbours(Tet t) const {
    for (const Face f : neighbours(t)) {
      __builtin_prefetch(&cells_[tet_of(f)]);
      __builtin_prefetch(&flags_[tet_of(f)]);
    }
  }
  [[nodiscard]] Flags flags(Tet t) const { return flags_[t]; }
  /// Marks of a search. The search clears them again: between two operations a mesh has no marks.
  void mark_visited(Tet t) { flags_[t] = static_cast<Flags>(flags_[t] | kVisited); }
  void clear_visited(Tet t) { flags_[t] = static_cast<Flags>(flags_[t] & ~kVisited); }
  [[nodiscard]] bool is_facet(Face f) const { return (flags_[tet_of(f)] & facet_bit(side_of(f))) != 0; }
  [[nodiscard]] bool is_segment(Tet t, int edge) const { return (flags_[t] & segment_bit(edge)) != 0; }

  [[nodiscard]] Vertex apex(Face f) const { return corner(tet_of(f), side_of(f)); }
  [[nodiscard]] std::array<Vertex, 3> face_vertices(Face f) const {
    return corners_of_face(corners(tet_of(f)), side_of(f));
  }
  /// Local index of v in t, or -1.
  [[nodiscard]] int index_of(Tet t, Vertex v) const { return index_among(corners(t), v); }
  /// Local number of the edge between two corners of t.
  [[nodiscard]] int edge_of(Tet t, Vertex a, Vertex b) const {
    return edge_between(index_of(t, a), index_of(t, b));
  }

  /// The two corners of t that are not on its edge ab, ordered so that (a b c d) is positive.
  [[nodiscard]] std::array<Vertex, 2> opposite_edge(Tet t, Vertex a, Vertex b) const {
    const auto& [c, d] = opposite_corners(index_of(t, a), index_of(t, b));
    return {corner(t, c), corner(t, d)};
  }

  /// Sign of det(b-a, c-a, d-a), exactly.
  [[nodiscard]] int orient(Vertex a, Vertex b, Vertex c, Vertex d) const {
    if (exact_in_use_ == 0)
      return exact::orient3d(positions_[a].data(), positions_[b].data(), positions_[c].data(),
                             positions_[d].data());
    return exact::orient3d(point(a), point(b), point(c), point(d));
  }
  /// orient(a, b, c, d) and orient(a, b, c, e), in less time than one after the other.
  [[nodiscard]] std::array<int, 2> orient_both(Vertex a, Vertex b, Vertex c, Vertex d, Vertex e) const {
    if (exact_in_use_ != 0) return {orient(a, b, c, d), orient(a, b, c, e)};
    const exact::OrientFilter filter(positions_[a].data(), positions_[b].data(), positions_[c].data());
    const int of_d = filter(positions_[d].data()), of_e = filter(positions_[e].data());
    return {of_d != 0 ? of_d : orient(a, b, c, d), of_e != 0 ? of_e : orient(a, b, c, e)};
  }
  [[nodiscard]] int orient(Vertex a, Vertex b, Vertex c, exact::PointRef d) const {
    return exact::orient3d(point(a), point(b), point(c), d);
  }

  /// Number of vertices whose position doubles cannot represent.
  [[nodiscard]] std::size_t exact_vertex_count() const { return exact_in_use_; }

 private:
  friend class MeshEditor;

  Vertex add_vertex(const Point& p);
  Vertex add_vertices(std::size_t count);
  void remove_vertex(Vertex v);
  void remove_last_vertex();
  void move_vertex(Vertex v, const Point& p);
  void move_vertex(Vertex v, const exact::ExactPoint& p);
  void set_incident(Vertex v, Tet t) {
    note_vertex(v);
    incident_[v] = t;
  }
  void reserve(std::size_t vertices, std::size_t tets);
  // The same for a mesh that grows in steps: what has to be copied gets room for later steps, too. Memory
  // that is not touched costs nothing.
  void make_room(std::size_t vertices, std::size_t tets);
  void renumber(std::span<const Tet> tets, Vertex first, std::span<const Vertex> vertices);
  void set_tets(std::vector<Cell> cells);

  // A free or new slot for put_tet to fill, from the pool of another slot if there are pools; and `count` new
  // contiguous slots.
  Tet take_slot(Tet near = kNone);
  Tet add_slots(std::size_t count);
  void drop_last_slots(std::size_t count);
  void put_tet(Tet t, const Corners& v, const Neighbours& n, Flags f) {
    note_slot(t);
    cells_[t] = {v, n};
    flags_[t] = f;
  }
  void remove_tet(Tet t);
  // What f sees; not what sees f.
  void set_neighbour(Face f, Face g) {
    note_slot(tet_of(f));
    cells_[tet_of(f)].neighbours[f & 3u] = g;
  }
  void set_flags(Tet t, Flags f) {
    note_slot(t);
    flags_[t] = static_cast<Flags>(flags_[t] | f);
  }
  void clear_flags(Tet t, Flags f) {
    note_slot(t);
    flags_[t] = static_cast<Flags>(flags_[t] & ~f);
  }

  // What this object notes its changes in (undo_log.h), and where its free slots are while parts are changed
  // at the same time (slot_pools.h): a copy has neither.
  struct Attached {
    UndoLog* log = nullptr;
    SlotPools* pools = nullptr;
    Attached() = default;
    Attached(const Attached&) {}
    Attached& operator=(const Attached&) { return *this; }  // NOLINT(bugprone-unhandled-self-assignment)
    ~Attached() = default;
  };
  // Called before a slot or a vertex changes.
  void note_slot(Tet t) {
    if (attached_.log != nullptr) [[unlikely]]
      tell_slot(t);
  }
  void note_vertex(Vertex v) {
    if (attached_.log != nullptr) [[unlikely]]
      tell_vertex(v);
  }
  void tell_slot(Tet t);
  void tell_vertex(Vertex v);
  void release_exact(Vertex v);

  std::vector<Cell> cells_;
  std::vector<Flags> flags_;
  std::vector<Tet> free_;  // slots; the last is filled first

  exact::DoubleGrid grid_;
  std::vector<Point> positions_;
  std::vector<std::uint32_t> exact_of_;  // index in exact_, or kNone
  std::vector<Tet> incident_;
  std::vector<exact::ExactPoint> exact_;
  std::vector<std::uint32_t> exact_free_;
  std::size_t exact_in_use_ = 0;
  Attached attached_;
};

}  // namespace holdfast
