// A tetrahedral mesh whose connectivity is right, but not all of its volumes: what untangling works on.
//
// TetMesh promises positive tetrahedra and a hull closed by ghosts; neither can be had here, where the
// boundary may be any set of faces and half of the mesh may be inside out. So this one is plain: corners, and
// for every vertex the tetrahedra at it. All neighbourhoods are found in stars, which stay right whatever the
// positions are. Signs are exact, and kept up to date.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "exact/volume.h"
#include "mesh/tet_mesh.h"
#include "numbers/sorted.h"

namespace holdfast {

/// How far tetrahedra are from being positive. A mesh is positive where its sum of |V| equals its sum of V,
/// which the boundary alone determines (paper §6.4): the less negative volume, the nearer.
struct Deficit {
  exact::Bounded volume;  ///< six times the absolute volume of the negative ones
  std::size_t count = 0;  ///< negative and null ones, exactly

  Deficit& operator+=(const Deficit& other) {
    volume += other.volume;
    count += other.count;
    return *this;
  }
  /// Surely less negative volume; or none on either side, and fewer null ones. The exact volume and then the
  /// count fall with every improvement, so that no sequence of improvements comes back.
  [[nodiscard]] bool better_than(const Deficit& other) const {
    if (volume.surely_below(other.volume)) return true;
    return volume.value == 0 && other.volume.value == 0 && count < other.count;
  }
};

/// What must stay: faces of the boundary, between regions and in facets; segments; the vertices of both.
struct Constraints {
  std::vector<std::array<Vertex, 3>> faces;     ///< corners ascending; in lexicographic order
  std::vector<std::array<Vertex, 2>> segments;  ///< ends ascending; in lexicographic order
  std::vector<bool> fixed;                      ///< by vertex
};

class Tangle {
 public:
  using Corners = TetMesh::Corners;

  /// Vertices that move, or come, get points of the grid.
  Tangle(std::span<const Point> points, std::vector<Corners> tets, std::vector<int> regions,
         Constraints constraints, const exact::DoubleGrid& grid = {});

  // --- vertices
  [[nodiscard]] std::size_t vertex_count() const { return points_.vertex_count(); }
  /// The vertices without tetrahedra, for kernels and exact tests.
  [[nodiscard]] const TetMesh& points() const { return points_; }
  [[nodiscard]] const Point& position(Vertex v) const { return points_.position(v); }
  [[nodiscard]] bool is_fixed(Vertex v) const { return constraints_.fixed[v]; }
  /// The tetrahedra at v; none for a vertex that is not in use.
  [[nodiscard]] std::span<const Tet> star(Vertex v) const { return star_[v]; }
  /// A free vertex.
  Vertex add_vertex(const Point& p);
  void move_vertex(Vertex v, const Point& p);

  // --- tetrahedra
  [[nodiscard]] std::size_t slot_count() const { return corners_.size(); }
  [[nodiscard]] std::size_t tet_count() const { return corners_.size() - dead_.size(); }
  [[nodiscard]] bool alive(Tet t) const { return region_of_[t].alive; }
  [[nodiscard]] const Corners& corners(Tet t) const { return corners_[t]; }
  [[nodiscard]] int region(Tet t) const { return region_of_[t].id; }
  /// Exactly.
  [[nodiscard]] int sign(Tet t) const { return sign_[t]; }
  [[nodiscard]] bool holds(Tet t, Vertex v) const { return index_of(t, v) >= 0; }
  [[nodiscard]] int index_of(Tet t, Vertex v) const;
  /// The vertices of a face, as TetMesh gives them: (f0 f1 f2 v) is positive if the tetrahedron is.
  [[nodiscard]] std::array<Vertex, 3> face(Tet t, int i) const;
  /// The tetrahedron on the other side of face i, or kNone.
  [[nodiscard]] Tet across(Tet t, int i) const;
  [[nodiscard]] std::size_t nonpositive_count() const { return nonpositive_; }
  [[nodiscard]] std::vector<Tet> nonpositive() const;
  /// Replaces tetrahedra of one region by others that have the same outer faces.
  void exchange(std::span<const Tet> old_tets, std::span<const Corners> new_tets);
  void remove_tet(Tet t);
  Tet add_tet(const Corners& corners, int region);

  // --- connectivity
  [[nodiscard]] bool has_edge(Vertex a, Vertex b) const;
  [[nodiscard]] bool has_face(Vertex a, Vertex b, Vertex c) const;
  [[nodiscard]] bool is_constraint(std::array<Vertex, 3> face) const;
  [[nodiscard]] bool is_segment(Vertex a, Vertex b) const;
  [[nodiscard]] const Constraints& constraints() const { return constraints_; }

  // --- measures
  /// Six times the signed volume, approximately.
  [[nodiscard]] exact::Bounded determinant(const Corners& corners) const;
  [[nodiscard]] Deficit deficit(const Corners& corners) const;
  [[nodiscard]] Deficit deficit(std::span<const Tet> tets) const;
  [[nodiscard]] Deficit deficit() const;

 private:
  [[nodiscard]] exact::Bounded absolute_volume(const Corners& corners) const;
  struct Region {
    int id;
    bool alive;
  };
  void set_sign(Tet t);

  TetMesh points_;
  std::vector<Corners> corners_;
  std::vector<Region> region_of_;
  std::vector<std::int8_t> sign_;
  std::vector<Tet> dead_;
  std::vector<std::vector<Tet>> star_;
  Constraints constraints_;
  std::size_t nonpositive_ = 0;
};

}  // namespace holdfast
