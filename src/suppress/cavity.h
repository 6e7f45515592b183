// A cavity that grows: the ball of a point and tetrahedra next to it, to be filled again without the point
// (Marot, Remacle 2020, "Quality tetrahedral mesh generation with HXT").
#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "mesh/tet_mesh.h"

namespace holdfast {

/// Whether a vertex, or an edge, belongs to one of some faces.
[[nodiscard]] bool any_holds(std::span<const std::array<Vertex, 3>> faces, Vertex v);
[[nodiscard]] bool any_holds(std::span<const std::array<Vertex, 3>> faces, Vertex u, Vertex v);

/// Strictly inside there is never a constraint, and no vertex except Steiner points, which are removed with
/// the cavity.
class Cavity {
 public:
  /// Starts with the ball of a Steiner point, in a mesh whose Steiner points are the vertices from
  /// `first_free` on and lie on no constraint.
  Cavity(const TetMesh& mesh, std::span<const Tet> ball, Vertex first_free);

  /// Adds a tetrahedron across one of the faces: one whose vertices are all in the cavity if there is any,
  /// else any at random. Returns false where none can be added.
  bool grow(std::mt19937_64& random);
  /// Adds the tetrahedron across the k-th face. Returns false where that is impossible.
  bool grow_across(std::size_t k);
  /// Adds the tetrahedron across the lowest face where that is possible; `heights` are one per face.
  bool grow_across_lowest(const std::vector<double>& heights);
  /// Adds the whole ball of a Steiner point on the boundary. Returns false, and adds none of it, where that
  /// is impossible.
  bool swallow(std::span<const Tet> ball);

  [[nodiscard]] const std::vector<Tet>& tets() const { return tets_; }
  /// Faces, such that a point x inside sees them with orient(f0, f1, f2, x) > 0.
  [[nodiscard]] const std::vector<std::array<Vertex, 3>>& faces() const { return faces_; }
  [[nodiscard]] std::size_t vertex_count() const { return corners().size(); }
  /// The Steiner points strictly inside.
  [[nodiscard]] std::vector<Vertex> inner() const;

 private:
  /// Of the faces, in ascending order.
  [[nodiscard]] const std::vector<Vertex>& corners() const;
  [[nodiscard]] bool holds(Tet t) const;
  bool add(Tet t);
  void renew_corners(Tet t);
  [[nodiscard]] bool may_add(Tet t) const;
  [[nodiscard]] bool encloses_a_constraint(Tet t) const;
  void drop_from(std::size_t size);
  [[nodiscard]] bool on_boundary(Vertex v) const { return any_holds(faces_, v); }
  [[nodiscard]] bool on_boundary(Vertex u, Vertex v) const { return any_holds(faces_, u, v); }
  void collect_faces();
  void collect_faces_of(Tet t);

  const TetMesh& mesh_;
  const Vertex first_free_;
  std::vector<Tet> tets_;
  std::vector<std::array<Vertex, 3>> faces_;
  std::vector<Tet> across_;              // by face
  std::vector<Vertex> apexes_;           // by face, of what is across
  mutable std::vector<Vertex> corners_;  // empty until they are asked for
  // Before the last tetrahedron was added; kept to allocate nothing.
  std::vector<std::array<Vertex, 3>> faces_before_;
  std::vector<Tet> across_before_;
  std::vector<Vertex> apexes_before_;
  std::vector<std::uint64_t> candidates_;
};

}  // namespace holdfast
