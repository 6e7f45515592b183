// The constraint that flips are to recover, and what a face or edge costs that stands in its way.
#pragma once

#include <array>

#include "mesh/edge_removal.h"
#include "mesh/tet_mesh.h"

namespace holdfast {

/// A missing segment or facet. Costs count how often the mesh pierces it; a segment is an edge (a facet
/// with its sides in place is a face) exactly when the total over all faces and edges is zero.
class Target {
 public:
  /// Crossing an edge is worth more than crossing a face: it has a whole shell round it.
  static constexpr int kFaceCost = 2;
  static constexpr int kEdgeCost = 3;

  /// Nothing stands in the way of nothing.
  static Target none() { return {{kNone, kNone, kNone}, Kind::none}; }
  static Target segment(Vertex a, Vertex b) { return {{a, b, kNone}, Kind::segment}; }
  static Target facet(const std::array<Vertex, 3>& abc) { return {abc, Kind::facet}; }

  [[nodiscard]] bool is_segment() const { return kind_ == Kind::segment; }
  /// False only where nothing among the vertices of a shell costs anything: their box is apart.
  [[nodiscard]] bool may_meet(const TetMesh& mesh, const EdgeShell& shell) const;
  /// Cost of the face uvw: its inside crossed by the segment. Facets: 0.
  [[nodiscard]] int face(const TetMesh& mesh, Vertex u, Vertex v, Vertex w) const;
  /// Cost of the edge uv: its inside crosses that of the segment or facet.
  [[nodiscard]] int edge(const TetMesh& mesh, Vertex u, Vertex v) const;

 private:
  enum class Kind { none, segment, facet };
  Target(const std::array<Vertex, 3>& corners, Kind kind) : v_(corners), kind_(kind) {}

  std::array<Vertex, 3> v_;
  Kind kind_;
};

}  // namespace holdfast
