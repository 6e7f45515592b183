// Tetrahedra by their corners alone: what a mesh is while points lie in one place and tetrahedra are null.
//
// Positions are those of a TetMesh, which gets a vertex for every copy of a point and keeps their exact
// places. Orientation is combinatorial: each tetrahedron is listed so that all would be positive if no two
// points coincided.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "mesh/keys.h"
#include "mesh/tet_mesh.h"

namespace holdfast::literal {

class Soup {
 public:
  using Corners = TetMesh::Corners;
  using Number = std::uint32_t;

  /// The tetrahedra of a mesh but for its ghosts, and its facet bits' faces as facets of unknown number. The
  /// mesh must outlive it.
  explicit Soup(TetMesh& mesh);

  [[nodiscard]] TetMesh& mesh() { return mesh_; }
  [[nodiscard]] const TetMesh& mesh() const { return mesh_; }
  [[nodiscard]] const std::vector<Corners>& tets() const { return tets_; }
  [[nodiscard]] bool alive(Number t) const { return alive_[t]; }
  /// Those at a vertex.
  [[nodiscard]] const std::vector<Number>& ball(Vertex v) const { return at_[v]; }
  [[nodiscard]] bool has_edge(Vertex a, Vertex b) const;

  Number add(const Corners& corners);
  void remove(Number t);
  /// Another vertex in the same place.
  Vertex copy(Vertex v);

  /// The facet that a face is a piece of.
  [[nodiscard]] std::optional<Index> facet_of(const std::array<Vertex, 3>& face) const;
  void set_facet(const std::array<Vertex, 3>& face, Index facet) { facets_[face_key(face)] = facet; }
  void clear_facet(const std::array<Vertex, 3>& face) { facets_.erase(face_key(face)); }
  [[nodiscard]] const std::map<FaceKey, Index>& facets() const { return facets_; }

  struct Counts {
    std::size_t positive = 0, null = 0, negative = 0;
  };
  /// By the exact signs of their volumes.
  [[nodiscard]] Counts count() const;

 private:
  TetMesh& mesh_;
  std::vector<Corners> tets_;
  std::vector<bool> alive_;
  std::vector<std::vector<Number>> at_;
  std::map<FaceKey, Index> facets_;
};

/// +1 where q lists the corners of t in an even permutation, -1 in an odd one.
[[nodiscard]] int parity(const TetMesh::Corners& t, const TetMesh::Corners& q);

}  // namespace holdfast::literal
