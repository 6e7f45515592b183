// The constraint that flips should recover, and the cost of a face or edge in its way.
#pragma once

#include <array>

#include "mesh/tet_mesh.h"

namespace holdfast {

/// A missing segment or facet. Costs count how often the mesh pierces it; a segment is an edge (a facet
/// with its sides in place is a face) exactly when the total over all faces and edges is zero.
class Target {
 public:
  /// Crossing an edge is worth more than crossing a face: it has a whole shell round it.
  static constexpr int kFaceCost = 2;
  static constexpr int kEdgeCost = 3;

  /// An empty target, which nothing crosses.
  static Target none() { return {{kNone, kNone, kNone}, Kind::none}; }
  static Target segment(Vertex a, Vertex b) { return {{a, b, kNone}, Kind::segment}; }
  static Target facet(const std::array<Vertex, 3>& abc) { return {abc, Kind::facet}; }

  [[nodiscard]] bool is_segment() const { return kind_ == Kind::segment; }
  /// False only if no face or edge among vertices in this box (of their doubles) costs anything, because the
  /// target is apart from the box.
  [[nodiscard]] bool may_meet(const TetMesh& mesh, const Point& low, const Point& high) const;
  /// Cost of the face uvw: its inside crossed by the segment. Facets: 0.
  [[nodiscard]] int face(const TetMesh& mesh, Vertex u, Vertex v, Vertex w) const;
  /// For a segment: the side on which the edge uv passes it; 0 if the lines of the two meet.
  [[nodiscard]] int side(const TetMesh& mesh, Vertex u, Vertex v) const {
    const auto [a, b, none] = v_;
    return u == a || v == a || u == b || v == b ? 0 : mesh.orient(a, b, u, v);
  }
  /// Cost of a face whose three edges pass the segment on the same side, not 0.
  [[nodiscard]] int face_round(const TetMesh& mesh, Vertex u, Vertex v, Vertex w) const {
    const auto [of_a, of_b] = mesh.orient_both(u, v, w, v_[0], v_[1]);
    return of_a * of_b < 0 ? kFaceCost : 0;
  }
  /// Cost of the edge uv: its inside crosses that of the segment or facet.
  [[nodiscard]] int edge(const TetMesh& mesh, Vertex u, Vertex v) const;

 private:
  enum class Kind { none, segment, facet };
  Target(const std::array<Vertex, 3>& corners, Kind kind) : v_(corners), kind_(kind) {}

  std::array<Vertex, 3> v_;
  Kind kind_;
};

}  // namespace holdfast
